#pragma once

#include <cstddef>
#include <vector>

#include "libbase/numerics/interpolation.hpp"
#include "libfe/parts/bearings/coefficients.hpp"

namespace whirl::inline fe {

/// Coefficients over the speed, the whirl frequency, or both; constant beyond the ends.
///
/// At least one row. Speeds do not descend; whirl frequencies ascend among rows of one speed, and
/// need not be the same at every speed. Without whirl frequencies, speeds ascend.
struct CoefficientTable {
  std::vector<double> speed;  ///< of every row [rad/s]; empty: no matter what it is
  std::vector<BearingCoefficients> rows;
  std::vector<double> whirl{};  ///< of every row [rad/s], not negative; empty likewise

  /// Coefficients at a speed and a whirl frequency: over the whirl frequency at every speed around
  /// Omega first, then over the speed.
  BearingCoefficients at(double Omega, double omega,
                         Interpolation how = Interpolation::linear) const;

  /// The same of a table that does not know whirl frequencies, or where they are the speed.
  BearingCoefficients at(double Omega) const { return at(Omega, Omega); }
  bool operator==(const CoefficientTable&) const = default;
};

}  // namespace whirl::inline fe
