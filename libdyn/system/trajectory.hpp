#pragma once
/// What all integrators share: the state of a motion, a step with dense output, options, outcomes.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// Where a motion is. Time is a whole number of revolutions and a phase, so that no digits are
/// lost.
struct MotionState {
  long revolution = 0;
  double phase = 0.0;  ///< within the revolution, 0 <= phase < 2 pi [rad]
  Vec y;               ///< (eta, eta')
  ContactStates contacts;

  Instant instant() const { return {phase, revolution}; }
};

/// One step of a motion without an event inside, as polynomials in s = (t - start) / h.
struct Step {
  long revolution = 0;
  double phase = 0.0;  ///< at the start [rad]
  double h = 0.0;      ///< duration [s]
  Mat q, v;            ///< coefficients of eta and eta', n x (degree + 1)
  ContactStates contacts;

  /// Where it starts, and how long it takes.
  void set(const Clock& clock, const Instant& from, double duration) {
    revolution = from.revolution;
    phase = from.phase;
    h = duration;
    turn_ = clock.turn(duration);
  }
  /// Angle of the rotor, from the start of the revolution [rad].
  double angle(double s) const { return phase + s * turn_; }
  /// By which the rotor turns in it [rad].
  double turn() const { return turn_; }
  Instant instant(double s) const { return {angle(s), revolution}; }
  /// The s at which the rotor has turned by an angle since the start [rad], of one beyond the step
  /// the nearest end.
  double after_turn(double by) const { return std::clamp(by / turn_, 0.0, 1.0); }

  /// State at 0 <= s <= 1.
  void at(double s, double* y) const {
    const StateLayout layout(q.rows());
    auto displacement = layout.eta(y), rate = layout.rate(y);
    displacement = q.col(q.cols() - 1);
    for (auto k = q.cols() - 2; k >= 0; --k) displacement = displacement * s + q.col(k);
    rate = v.col(v.cols() - 1);
    for (auto k = v.cols() - 2; k >= 0; --k) rate = rate * s + v.col(k);
  }
  /// The step up to 0 < s <= 1.
  Step first_part(double s) const {
    Step part = *this;
    double power = 1.0;
    for (Eigen::Index k = 1; k < std::max(q.cols(), v.cols()); ++k) {
      power *= s;
      if (k < q.cols()) part.q.col(k) *= power;
      if (k < v.cols()) part.v.col(k) *= power;
    }
    part.h *= s;
    part.turn_ *= s;
    return part;
  }
  /// Acceleration of the coordinates at 0 <= s <= 1, the slope of the velocity.
  void acceleration(double s, Vec& a) const {
    a.setZero(v.rows());
    for (auto k = v.cols() - 1; k >= 1; --k) a = a * s + static_cast<double>(k) * v.col(k);
    a /= h;
  }

 private:
  double turn_ = 0.0;
};

/// Called with every step; returns false to stop the integration after it.
using Observer = std::function<bool(const Step&)>;

struct IntegrationOptions {
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  double fixed_step = 0.0;   ///< [s]; not 0: no error control, steps of this size between events
                             ///< (one-step methods)
};

/// Displacement beyond which a motion is given up, in length scales: with a clearance of 1 mm
/// nearly three times as far as the moon.
constexpr double boundless = 1e12;
constexpr const char* boundless_text = "the motion grows without bound";

enum class Outcome {
  reached_end,
  stopped_by_observer,
  step_too_small,
  not_finite,
  left_bearing  ///< a journal is not inside its bearing, where its oil film has no force
};

struct Cost {
  long steps = 0;  ///< accepted
  long rejected = 0;
  long evaluations = 0;  ///< of the equations of motion
  long events = 0;       ///< touching, parting, reversals of slip, sticking

  Cost& operator+=(const Cost& other) {
    steps += other.steps;
    rejected += other.rejected;
    evaluations += other.evaluations;
    events += other.events;
    return *this;
  }
};

struct Integration {
  Outcome outcome = Outcome::reached_end;
  Cost cost;
  Failure failure;  ///< when, which contact, in which state
};

}  // namespace whirl::inline dyn
