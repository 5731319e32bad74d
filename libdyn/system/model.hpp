#pragma once
/// Everything that a model file says.

#include <string>
#include <vector>

#include "libcontact/contact.hpp"
#include "libcontact/oil_film.hpp"
#include "libfe/analyses/reduce.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline dyn {

/// A complex mode at speed, added to the start of a simulation.
struct WhirlStart {
  int mode = 1;            ///< number from 1, as `modes` lists them at the operating speed
  double amplitude = 0.0;  ///< largest lateral radius [m]
  double phase = 0.0;      ///< [rad]
  Where where{};           ///< of the mode, for errors
};

/// A place that is moved aside, or thrown, at the start of a simulation.
struct Displaced {
  Station at;
  double x = 0.0, y = 0.0;    ///< added displacement [m]
  double vx = 0.0, vy = 0.0;  ///< added velocity [m/s]
};

enum class StartFrom { rest, equilibrium, file };
constexpr auto choices(StartFrom) {
  return std::array{Choice<StartFrom>{"rest", StartFrom::rest},
                    Choice<StartFrom>{"static", StartFrom::equilibrium},
                    Choice<StartFrom>{"file", StartFrom::file}};
}

/// Start of a simulation.
struct Start {
  StartFrom from = StartFrom::equilibrium;
  std::string file;                  ///< result whose end is the start (StartFrom::file)
  std::vector<WhirlStart> whirl;     ///< added to that state
  std::vector<Displaced> displaced;  ///< added as well
};

/// Speeds that a machine is run at, for lateral analyses [rad/s]; 0: not told.
struct MachineSpeeds {
  double minimum = 0.0, maximum = 0.0;  ///< continuously
  double trip = 0.0;                    ///< at which the machine is stopped

  static constexpr auto fields() {
    using enum Range;
    using S = MachineSpeeds;
    return std::tuple{
        alternative("minimum_speed", &S::minimum, "rad/s", positive,
                    "least continuous speed, for lateral; left out: speed"),
        alternative("maximum_speed", &S::maximum, "rad/s", positive,
                    "largest continuous speed, for lateral; left out: speed"),
        alternative("trip_speed", &S::trip, "rad/s", positive,
                    "at which it is stopped, for lateral; left out: 1.05 times the largest")};
  }
};

struct Model {
  std::string title;
  std::string source;  ///< text of the model file, with everything set from the command line
  std::string path;    ///< where the text came from
  Structure structure;
  std::vector<Contact> contacts;
  std::vector<OilFilm> films;
  double speed = 0.0;      ///< operating speed [rad/s]
  bool has_speed = false;  ///< whether the model says a speed
  MachineSpeeds machine{};
  Reduction reduction;
  Start start;
};

}  // namespace whirl::inline dyn
