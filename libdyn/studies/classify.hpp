#pragma once
/// The kind of a steady motion: what its tangents and its sections say together.

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/flow/free_flight.hpp"
#include "libdyn/studies/exponents.hpp"
#include "libdyn/studies/settling.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/contact_system.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Files hold these by their numbers: new ones come last.
enum class MotionKind { equilibrium, periodic, quasi_periodic, chaotic, hyperchaotic, not_settled };
constexpr auto choices(MotionKind) {
  return std::array{Choice<MotionKind>{"equilibrium", MotionKind::equilibrium},
                    Choice<MotionKind>{"periodic", MotionKind::periodic},
                    Choice<MotionKind>{"quasi-periodic", MotionKind::quasi_periodic},
                    Choice<MotionKind>{"chaotic", MotionKind::chaotic},
                    Choice<MotionKind>{"hyperchaotic", MotionKind::hyperchaotic},
                    Choice<MotionKind>{"not settled", MotionKind::not_settled}};
}

struct ClassifyOptions {
  long discard = 500;        ///< revolutions before, for the transient, at most
  long revolutions = 1000;   ///< beyond it, over which contacts are measured
  long exponents = 1000;     ///< of these, over which exponents are averaged, at most
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  /// That is looked for [revolutions]; that after which forces repeat, if it is longer, too.
  int longest_period = 32;
  long sections = 0;  ///< how many of the last ones are kept
  /// Not 0: by the classical Runge-Kutta method with so many equal steps a revolution, to see what
  /// studies that use it see. What repeats within 1e-4 length scales is periodic then, and nothing
  /// is proven.
  long rk4_steps = 0;
  Eigen::Index path = 0;  ///< at how many numbers of revolutions exponents are told at most
  /// Called now and then with the revolutions done by all motions together; false: stop.
  std::function<bool(long)> watch;
};

/// What a motion becomes.
struct Classification {
  MotionKind kind = MotionKind::periodic;
  int period =
      0;  ///< of a periodic motion [revolutions]; 0: not periodic, or longer than looked for
  /// Of a periodic motion under loads of which none turns with the rotor: time after which it
  /// repeats, in no whole number of revolutions in most cases [s]; 0: not looked for, or not found.
  double period_time = 0.0;
  /// All Lyapunov exponents per revolution, descending. Of a proven periodic motion they are those
  /// of its Floquet multipliers, else means.
  Vec exponents;
  ExponentPath path{};     ///< how they settled, if asked for; empty of an orbit that is proven
  bool is_proven = false;  ///< periodic: the orbit was found, and it attracts
  /// Of a proven orbit: no contact can happen on the way to it, so that it is that of the linear
  /// rotor; else Newton's method found it.
  bool is_free = false;
  double residual = 0.0;    ///< of a proven orbit after its period, in length scales
  double zero = 0.0;        ///< exponents within +-this count as zero [1/revolution]
  double resolution = 0.0;  ///< the largest one of 99 of 100 motions is within +-this of its limit
  Drift drift;              ///< of the sections, where the orbit is not proven
  /// Of a motion that has not settled: after how many revolutions since its start it would have, by
  /// the decay that was seen; 0: none was seen.
  long settles_after = 0;
  /// Of the set that the sections at phase 0 lie on: 1 for a closed curve (see
  /// libbase/numerics/fractal_dimension.hpp); NaN where the orbit is proven, or too few sections
  /// are known.
  double section_dimension = std::numeric_limits<double>::quiet_NaN();
  /// That contacts were measured over: the period, or all that were averaged.
  long revolutions = 0;
  long transient = 0;  ///< revolutions until the motion was known to be periodic, or all
  std::vector<ContactMeasure> contacts;  ///< without mean slips
  std::vector<double> sections;          ///< states at phase 0, the last ones, if asked for
  MotionState end;                       ///< a state on the motion
  Outcome outcome = Outcome::reached_end;
  Failure failure;

  bool is_good() const { return outcome == Outcome::reached_end; }
  /// Impacts of all contacts, the p of the p/n notation (n: revolutions).
  double impacts() const;
};

/// A motion to be classified; its end is where it begins.
struct ClassifyCandidate {
  const ContactSystem* system = nullptr;
  Classification found;
  std::shared_ptr<FreeFlight> flight{};  ///< of the system, once it was asked for
};

/// Integrates motions through their transients, together in the lanes of a batch.
///
/// Ever later, the sections at phase 0 are searched for a period p. Newton's method on the p-th
/// return map, with the tangent, then finds the orbit itself; if its multipliers lie within the
/// unit circle and it is where the motion was, the motion is periodic: this is proven, and the rest
/// of the transient is left out.
///
/// @throws NumericalError  if a system has no coordinates
/// @source [LeineNijmeijer2004] for multipliers of nonsmooth flows
void settle(std::span<ClassifyCandidate> motions, const ClassifyOptions& options);

/// Tells what those motions are that are not proven to be periodic, from averaged exponents.
///
/// A motion is hyperchaotic or chaotic with two or one of them above zero, as estimate_exponents
/// has it; else it is quasi-periodic if the largest counts as zero or forces do not repeat, and
/// periodic otherwise, unless means over
/// its sections still change by more than 2 % of their spread: then it has not settled. What decays
/// has a time after which it would have; without contact this follows from the linear rotor.
///
/// @source [Benettin1980] for exponents, [SanderMeiss2020] for means
void average(std::span<ClassifyCandidate> motions, const ClassifyOptions& options);

/// Both: what a motion becomes from a start.
Classification classify(const ContactSystem& system, MotionState start,
                        const ClassifyOptions& options);

}  // namespace whirl::inline dyn
