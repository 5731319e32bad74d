#pragma once
/// When something is, by the angle of a shaft.

#include <cmath>
#include <numbers>

namespace whirl::inline base {

/// When: a phase within a revolution, and which revolution that is. Only what does not repeat with
/// the revolution asks for the latter.
struct Instant {
  double phase = 0.0;  ///< [rad]
  long revolution = 0;

  Instant(double at_phase, long in_revolution = 0) : phase(at_phase), revolution(in_revolution) {}
};

/// Angle of what turns `ratio` times as fast as the phase, at the start of a revolution, from 0 to
/// 2 pi [rad]; without a revolution's whole turns, which would cost digits.
inline double start_angle(double ratio, long revolution) {
  const auto r = static_cast<double>(revolution);
  const double turns = ratio * r, rest = std::fma(ratio, r, -turns);
  return 2.0 * std::numbers::pi * (turns - std::floor(turns) + rest);
}
/// The same at an instant.
inline double angle_at(double ratio, const Instant& at) {
  return start_angle(ratio, at.revolution) + ratio * at.phase;
}

}  // namespace whirl::inline base
