#pragma once
/// At which cross-coupled stiffness a frequency is an eigenvalue.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Both p = 1 / Q of a receptance H(s) (x, y), the larger one first. With a cross-coupled stiffness
/// Q, f_x = -Q y and f_y = Q x, s is an eigenvalue where
///
///   p^2 + b p + d = 0,   b = H_yx - H_xy,   d = det H(s).
///
/// A Q that is real is one of the rotor. Both are followed over s, each by itself: without
/// gyroscopics they are p and -p, and real at once.
struct InverseCouplings {
  std::array<Complex, 2> p;  ///< [m/N]

  /// @param H  2 x 2, of motions e^(s t) [m/N]
  explicit InverseCouplings(const Eigen::Matrix2cd& H) {
    const Complex b = H(1, 0) - H(0, 1), d = H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0);
    const Complex root = std::sqrt(0.25 * b * b - d);
    const Complex half = -0.5 * b;
    const Complex large = std::abs(half + root) > std::abs(half - root) ? half + root : half - root;
    p = {large, large == 0.0 ? large : d / large};
  }
  /// In the order of another pair: each beside the one that it is nearer to.
  InverseCouplings as(const std::array<Complex, 2>& other) const {
    InverseCouplings turned = *this;
    const double same = std::abs(p[0] - other[0]) + std::abs(p[1] - other[1]);
    const double swapped = std::abs(p[0] - other[1]) + std::abs(p[1] - other[0]);
    if (swapped < same) std::swap(turned.p[0], turned.p[1]);
    return turned;
  }
  /// Whether it is clear which one is which of another pair.
  bool is_like(const InverseCouplings& other) const {
    const double moved = std::max(std::abs(p[0] - other.p[0]), std::abs(p[1] - other.p[1]));
    return moved <= 0.5 * std::min(std::abs(p[0] - p[1]), std::abs(other.p[0] - other.p[1]));
  }
  double size() const { return std::max(std::abs(p[0]), std::abs(p[1])); }
};

}  // namespace whirl::inline fe
