#pragma once
/// Speed against error of integrators, on one motion.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/methods/methods.hpp"

namespace whirl::inline dyn {

/// What errors are measured against: where a motion really is after some revolutions.
struct ReferenceMotion {
  Vec end;               ///< (eta, eta')
  double error = 0.0;    ///< of this end, estimated from two independent settings; as distance
  double growth = 1.0;   ///< of a small deviation over these revolutions
  std::string made_by;   ///< in words
  long revolutions = 0;  ///< from the start

  static constexpr auto columns() {
    return ColumnList{column("made_by", &ReferenceMotion::made_by, "", "how"),
                      column("error", &ReferenceMotion::error, "", "its own"),
                      column("growth", &ReferenceMotion::growth, "", "of a small deviation")};
  }

  /// Whether the deviation became as large as the motion: growth then is a lower bound.
  bool is_lost() const { return growth > 1e6; }
};

/// Reference by Taylor series in quadruple precision (integrate_quad) where that works and takes
/// seconds, else by DOP853.
///
/// @throws NumericalError  if the motion cannot be integrated
ReferenceMotion reference_motion(const ContactSystem& system, const MotionState& start,
                                 long revolutions);

/// Reference in quadruple precision. Its own error is the difference from a run of another order
/// with other steps, and the rounding of its end to double.
ReferenceMotion quad_reference(const ContactSystem& system, const MotionState& start,
                               long revolutions);

/// Reference by DOP853 at its tightest tolerance. Its own error is the difference from a run with
/// other steps, at ten times this tolerance.
ReferenceMotion dop853_reference(const ContactSystem& system, const MotionState& start,
                                 long revolutions);

/// Something to be measured, which moves a state on by whole revolutions at a tolerance.
struct Candidate {
  std::string name;
  std::function<Integration(MotionState& state, long revolutions, double tolerance)> move;
  double motions = 1.0;  ///< that one call moves at once and that share its time
};

/// Names of all that can be measured: the methods of the list, and `taylor-batch` and `rk4-batch`,
/// which move 16 motions from the same state at once, in one thread.
std::vector<std::string_view> candidate_names();

/// The candidate of one of these names; the system must outlive the candidate.
/// @throws ModelError  for an unknown name
Candidate candidate(const ContactSystem& system, std::string_view name);

struct TimingOptions {
  int most_runs = 5;         ///< whose median counts
  double most_time = 0.1;    ///< after which a run is not repeated any more [s]
  double least_time = 1e-3;  ///< of a measurement; short runs are measured several at a time [s]
};

/// One point of a work-precision diagram.
struct TimedRun {
  std::string method;
  double tolerance = 0.0;
  double error = 0.0;  ///< NaN if it failed
  double time = 0.0;   ///< processor time of a revolution, median [s]
  Integration integration;

  bool has_failed() const { return integration.outcome != Outcome::reached_end; }
  long steps() const { return integration.cost.steps; }
  long evaluations() const { return integration.cost.evaluations; }
  long events() const { return integration.cost.events; }
  /// Time of a revolution [ns]; nothing if it failed.
  std::optional<double> nanoseconds() const {
    return has_failed() ? std::nullopt : std::optional(1e9 * time);
  }
  Failure failure() const { return has_failed() ? integration.failure : Failure(); }

  static constexpr auto columns() {
    return ColumnList{
        column("method", &TimedRun::method, "", "method"),
        column("tolerance", &TimedRun::tolerance, "", "of its steps"),
        column("error", &TimedRun::error, "", "at the end"),
        column("ns_per_revolution", &TimedRun::nanoseconds, "", "processor time"),
        column("steps", &TimedRun::steps, "", "steps"),
        column("evaluations", &TimedRun::evaluations, "", "of the equations of motion"),
        column("events", &TimedRun::events, "", "events"),
        column("failure", &TimedRun::failure, "", "why").only(Written::in_json).maybe()};
  }
};

/// Measures a candidate from a state to the end of the reference.
TimedRun measure(const Candidate& candidate, double tolerance, const ContactSystem& system,
                 const MotionState& start, const ReferenceMotion& reference,
                 const TimingOptions& options = {});

}  // namespace whirl::inline dyn
