#pragma once

#include <algorithm>
#include <vector>

#include "libfe/bearings/coefficients.hpp"

namespace whirl::inline fe {

/// Coefficients over speed: linear between its rows, constant beyond its ends.
///
/// At least one row; speeds strictly increasing.
struct CoefficientTable {
  std::vector<double> speed;              ///< [rad/s]
  std::vector<BearingCoefficients> rows;  ///< one per speed

  BearingCoefficients at(double Omega) const {
    const auto above = std::upper_bound(speed.begin(), speed.end(), Omega);
    if (above == speed.begin()) return rows.front();
    if (above == speed.end()) return rows.back();
    const auto i = static_cast<std::size_t>(above - speed.begin());
    const double s = (Omega - speed[i - 1]) / (speed[i] - speed[i - 1]);
    const auto mix = [&](Mat2 BearingCoefficients::*part) -> Mat2 {
      return (1.0 - s) * (rows[i - 1].*part) + s * (rows[i].*part);
    };
    return {mix(&BearingCoefficients::K), mix(&BearingCoefficients::C),
            mix(&BearingCoefficients::Kt), mix(&BearingCoefficients::Ct)};
  }
};

}  // namespace whirl::inline fe
