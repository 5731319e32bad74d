#pragma once
/// Newton's method.

#include <optional>

#include "libbase/dense.hpp"

namespace whirl {

/// J^-1 r, a step of Newton's method; nothing where J is as good as singular.
inline std::optional<Vec> newton_step(const Mat& J, const Vec& r) {
  constexpr double singular = 1e-14;  // reciprocal condition, at which no digit of a step is right
  const DenseLu<Mat> lu(J);
  if (!(lu.rcond() > singular)) return std::nullopt;
  return Vec(lu.solve(r));
}

/// Whether a residual is small, or small enough and no longer falling, as rounding and events leave it.
inline bool has_converged(double residual, double before, double accurate = 1e-11) {
  constexpr double reachable = 1e-8;
  return residual < accurate || (residual < reachable && residual > 0.5 * before);
}

}  // namespace whirl
