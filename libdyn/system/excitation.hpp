#pragma once
/// A load of a reduced system, over the angle that it has gone through.

#include "libbase/numerics/linalg.hpp"
#include "libdyn/system/clock.hpp"

namespace whirl::inline dyn {

/// cosine cos(alpha) + sine sin(alpha), alpha = ratio times the angle of the rotor.
struct ReducedExcitation {
  double order = 0.0;      ///< of the speed; 0: a frequency of its own, or constant
  double frequency = 0.0;  ///< [rad/s]
  double ratio = 0.0;      ///< of that to the rate of the phase; 0: constant
  Vec cosine, sine;        ///< accelerations of the coordinates

  bool is_zero() const { return cosine.isZero(0.0) && sine.isZero(0.0); }
  double angle(const Instant& at) const { return ratio == 1.0 ? at.phase : angle_at(ratio, at); }
};

}  // namespace whirl::inline dyn
