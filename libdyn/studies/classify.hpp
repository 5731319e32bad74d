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

/// Files hold kinds by their numbers: new kinds come last.
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
  long discard = 500;       ///< revolutions before, for the transient, at most
  long revolutions = 1000;  ///< beyond the transient, over which contacts are measured
  long exponents = 1000;    ///< of these, over which exponents are averaged, at most
  int most_exponents = 0;   ///< the largest ones, of which two tell every kind; 0: all
  /// Exponents are averaged no longer once the largest is known to this and above zero
  /// [1/revolution]; 0: over all revolutions.
  double resolution = 0.0;
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  /// Longest period that is looked for [revolutions]; the period of the forces, too, if it is
  /// longer.
  int longest_period = 32;
  long sections = 0;  ///< how many of the last sections are kept
  /// Not 0: motions are those of the classical Runge-Kutta method with so many equal steps a
  /// revolution, to see what studies by this method see. A motion that repeats within 1e-4 length
  /// scales is periodic then, and nothing is proven.
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
  /// Of a periodic motion under loads none of which turns with the rotor: time after which the
  /// motion repeats, in most cases no whole number of revolutions [s]; 0: not looked for, or not
  /// found.
  double period_time = 0.0;
  /// Lyapunov exponents per revolution, descending, as many as asked for. Exponents of a proven
  /// periodic motion are those of its Floquet multipliers, others are means.
  Vec exponents;
  ExponentPath path{};     ///< how exponents settled, if asked for; empty if proven
  bool is_proven = false;  ///< periodic: the orbit was found, and it attracts
  /// Of a proven orbit: no contact can happen on the way to this orbit, which is therefore that of
  /// the linear rotor; else Newton's method found it.
  bool is_free = false;
  double residual = 0.0;    ///< of a proven orbit after its period, in length scales
  double zero = 0.0;        ///< exponents within +-this count as zero [1/revolution]
  double resolution = 0.0;  ///< bound of the largest exponent's error in 99 of 100 motions
  Drift drift;              ///< of the sections, where the orbit is not proven
  /// Of a motion that has not settled: revolutions from its start after which it would have
  /// settled, by the decay that was seen; 0: no decay was seen.
  long settles_after = 0;
  /// Dimension of the set that the sections at phase 0 lie on: 1 for a closed curve (see
  /// libbase/numerics/fractal_dimension.hpp); NaN where the orbit is proven, or too few sections
  /// are known.
  double section_dimension = std::numeric_limits<double>::quiet_NaN();
  /// Revolutions over which contacts were measured: the period, or all that were averaged.
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

/// A motion to be classified, which begins at found.end.
struct ClassifyCandidate {
  const ContactSystem* system = nullptr;
  Classification found;
  std::shared_ptr<FreeFlight> flight{};  ///< of the system, once asked for
};

/// Integrates motions through their transients, together in the lanes of a batch.
///
/// Ever later, the sections at phase 0 are searched for a period p. Newton's method on the p-th
/// return map, with the tangent, then finds the orbit itself; if the multipliers of this orbit lie
/// within the unit circle and the orbit is where the motion was, the motion is proven to be
/// periodic, and the rest of the transient is left out.
///
/// @throws NumericalError  if a system has no coordinates
/// @source [LeineNijmeijer2004] for multipliers of nonsmooth flows
void settle(std::span<ClassifyCandidate> motions, const ClassifyOptions& options);

/// Tells the kinds of the motions that are not proven to be periodic, from averaged exponents.
///
/// A motion is chaotic with one exponent above the zero of estimate_exponents, and hyperchaotic
/// with more. Else it has not settled if means over its sections still change by more than 2 % of
/// their spread; it is quasi-periodic if the largest exponent counts as zero or forces do not
/// repeat; and it is periodic otherwise. A decay that is seen tells when a motion would have
/// settled; without contact the linear rotor tells it.
///
/// @source [Benettin1980] for exponents, [SanderMeiss2020] for means
void average(std::span<ClassifyCandidate> motions, const ClassifyOptions& options);

/// Settles and averages: what a motion becomes from a start.
Classification classify(const ContactSystem& system, MotionState start,
                        const ClassifyOptions& options);

}  // namespace whirl::inline dyn
