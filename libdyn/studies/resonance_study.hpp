#pragma once
/// Internal resonances of a rotor, with their modes in the contacts and bouncing motions nearby.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/studies/bouncing.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/resonance.hpp"

namespace whirl::inline dyn {

struct ResonanceOptions {
  std::vector<double> speeds;  ///< ascending [rad/s]
  int modes = 4;
  int largest = 4;        ///< of p and q
  bool confirms = false;  ///< look for bouncing motions near each resonance
  BouncingOptions search{};
  int threads = 1;  ///< of this process that look for bouncing motions; 0: the calling one
};

/// Orbits of both modes in a contact, over the largest orbit of each mode on the rotor.
struct ContactOrbits {
  std::string name;
  double fast = 0.0, slow = 0.0;  ///< major semi-axes; NaN where no mode is near

  static constexpr auto columns() {
    return ColumnList{column("name", &ContactOrbits::name, "", "contact"),
                      column("fast", &ContactOrbits::fast, "", "of the faster mode"),
                      column("slow", &ContactOrbits::slow, "", "of the slower mode")};
  }
};

/// A resonance, its modes in the contacts, and a bouncing motion near it.
struct ResonancePlace : InternalResonance {
  std::vector<ContactOrbits> contacts;
  std::optional<Bouncing> bouncing;
  bool is_confirmed = false;  ///< a bouncing motion was looked for, to the end

  double bouncing_speed() const;   ///< NaN: none was found, or looked for [rad/s]
  double bouncing_period() const;  ///< NaN: none was found, or looked for [revolutions]
  int bouncing_stable() const;     ///< 1 stable, 0 unstable, -1 none

  static constexpr auto columns() {
    using enum Written;
    constexpr double most_order = 1e6;
    constexpr auto found = [](const ResonancePlace& r) {
      return r.is_confirmed ? std::make_optional(r.bouncing) : std::nullopt;
    };
    return ColumnList{
        column("speed", &ResonancePlace::speed, "rad/s", "speed of the resonance").axis(),
        column("p", &ResonancePlace::p, "", "of the ratio p:q, of the faster mode")
            .within(valid::from_to(1.0, most_order)),
        column("q", &ResonancePlace::q, "", "of the ratio p:q, of the slower mode")
            .within(valid::from_to(1.0, most_order)),
        column("fast", &ResonancePlace::fast, "", "branch of the faster mode")
            .from_one()
            .within(valid::numbers_of("branches")),
        column("slow", &ResonancePlace::slow, "", "branch of the slower mode")
            .from_one()
            .within(valid::numbers_of("branches")),
        column("frequency", &ResonancePlace::frequency, "rad/s",
               "of both modes over p and q, seen from the rotor"),
        rows(&ResonancePlace::contacts, "contacts").only(in_json),
        column("bouncing", found, "", "a bouncing motion, where it was looked for")
            .only(in_json)
            .maybe(),
        column("bouncing_speed", &ResonancePlace::bouncing_speed, "rad/s",
               "where a bouncing motion was found")
            .only(in_file),
        column("bouncing_period", &ResonancePlace::bouncing_period, "",
               "its period seen from the rotor [revolutions]")
            .only(in_file),
        column("bouncing_stable", &ResonancePlace::bouncing_stable, "",
               "1 stable, 0 unstable, -1 none found or not looked for")
            .within(valid::from_to(-1.0, 1.0))
            .only(in_file)};
  }
};

/// Resonances beside their Campbell diagram; group /resonances.
struct ResonanceStudy {
  Campbell diagram;
  std::vector<ResonancePlace> places;  ///< ascending speed
  bool is_confirmed = false;           ///< bouncing motions were looked for
  bool is_whole = true;                ///< false: it was stopped

  static constexpr std::string_view group = "/resonances";
  static constexpr auto columns() {
    return ColumnList{rows(&ResonanceStudy::places, "resonances").maybe()};
  }
};

/// The model at another speed, reduced.
std::shared_ptr<const Scene> scene_at_speed(const Model& model, double speed);

/// Finds the resonances between some speeds, and bouncing motions near these if asked for; threads
/// and processes share that search.
/// @throws NumericalError  as campbell
ResonanceStudy resonance_study(const Model& model, const Assembler& assembler,
                               const ResonanceOptions& options,
                               const Monitor<ResonanceStudy>& monitor = {});

}  // namespace whirl::inline dyn
