#pragma once
/// Angle of the rotor against time.

#include <cmath>
#include <numbers>

#include "libbase/structs/instant.hpp"

namespace whirl::inline dyn {

/// A rotor of constant speed. A revolution is that of the shaft; without spin it is one second, so
/// that motions of a rotor that stands have a section, too.
class Clock {
 public:
  /// @param Omega  speed [rad/s], of either sense
  explicit Clock(double Omega = 0.0) : Omega_(Omega) {}

  double speed() const { return Omega_; }
  /// Rate of the phase [rad/s]: |Omega|, or 2 pi if the rotor does not spin.
  double rate() const { return Omega_ != 0.0 ? std::abs(Omega_) : 2.0 * std::numbers::pi; }
  /// Duration of a revolution [s].
  double period() const { return 2.0 * std::numbers::pi / rate(); }
  /// Phase passed in a time [rad].
  double turn(double duration) const { return duration * rate(); }
  /// Since the start of revolution 0 [s].
  double time_after(double revolutions) const { return period() * revolutions; }

 private:
  double Omega_;
};

}  // namespace whirl::inline dyn
