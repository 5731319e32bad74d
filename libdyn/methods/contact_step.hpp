#pragma once
/// One step of the collocation method: contact forces as polynomials of time.

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "libdyn/methods/step_forces.hpp"
#include "libdyn/system/events.hpp"

namespace whirl::inline dyn {

/// Motion of a contact over a step.
struct ContactPath {
  Mat values;  ///< d_x, d_y, w_x, w_y at places of the step, both ends included
  Mat powers;  ///< of s: d_x, d_y over the clearance

  ContactForces forces(const ReducedContact& contact, Eigen::Index place) const {
    const auto at = values.row(place);
    return forces_at(contact, Vec2(at(0), at(1)), Vec2(at(2), at(3)));
  }
};

/// A step: its contact forces (StepForces), and what the contacts do within it.
class ContactStep {
 public:
  /// @param longest  step size of rung 0 [s]
  ContactStep(const ContactSystem& system, double longest, double tolerance);

  double size(Rung rung) const { return tables_.size(rung); }
  /// The shortest rung that is not below a duration.
  Rung rung_for(double h) const { return tables_.rung_for(h); }

  /// Finds the forces of the contacts in touch over a step from a state. False if the forces were
  /// not found, or the motion is not finite.
  bool solve(Rung rung, const MotionState& from);

  /// Error of the step that was solved last, over the tolerance; by the scale of the state, or by
  /// the size of a state that has grown.
  double error() const { return forces_.error(); }
  /// Error of the contacts' displacements between samples, by the clearance.
  double path_error() const { return path_error_; }
  long evaluations() const { return forces_.evaluations(); }

  /// The first event before a fraction of the step, its place as a fraction of the whole step.
  /// @param is_sure  false if the paths are too coarse to tell whether there is an event
  std::optional<Event> first_event(const EventWatcher& watcher, double limit,
                                   const MotionState& from, bool& is_sure);

  /// Slope of the last event's function at this event, per step.
  double event_slope() const { return event_slope_; }

  /// The state after a fraction of the step.
  void advance(double fraction, const MotionState& from, Vec& y);

  /// States at fractions of a part of the step, as polynomials (see Step), with the step's end at
  /// `limit`; pieces as short as the fastest motion that is alive asks for.
  /// @param give  receives pieces in order, with the state at their end; false stops
  bool dense(const MotionState& from, double limit,
             const std::function<bool(const Step&, const Vec&)>& give);

 private:
  /// False if a contact moves out of what numbers can hold.
  bool make_paths(const MotionState& from);
  Polynomial polynomial(const EventWatcher& watcher, int contact, EventKind kind, double limit,
                        const ContactStates& states) const;
  /// What holds the contacts that slip like a given one, at a place of the step.
  Hold hold_at(Eigen::Index place, int contact, const ContactStates& states) const;
  struct Part {  ///< of the step, in fractions of the step
    int level;   ///< of the size of the part
    double start, width;
  };
  bool dense_piece(const MotionState& from, const Part& part, double limit, const Vec& y,
                   const Vec& a, const std::function<bool(const Step&, const Vec&)>& give);

  bool is_touching() const { return !forces_.motion().touching.empty(); }

  const ContactSystem& system_;
  double tolerance_;
  StepTables tables_;
  StepForces forces_;

  // of the last solve
  Vec end_;
  std::vector<ContactPath> paths_;
  double path_error_ = 0.0, event_slope_ = 0.0;
  double longest_piece_ = std::numeric_limits<double>::infinity();  ///< of dense output [s]
};

}  // namespace whirl::inline dyn
