#pragma once

#include "libfe/eigen/energy_bounds.hpp"
#include "libfe/eigen/quadratic.hpp"

namespace whirl::inline fe {

struct FrequencySearch {
  int count = 0;        ///< eigenvalues wanted in the sector
  double slope = 5.0;   ///< the sector is |Re lambda| < slope * Im lambda
  double center = 0.0;  ///< of the first disc, on the real axis, where K + s D + s^2 M is regular
  EnergyBounds bounds;  ///< leave out where no eigenvalue can be
};

/// The eigenpairs of lowest Im lambda within a sector about the imaginary axis, however many others
/// (creeping, overdamped ones) are nearer to zero or between.
///
/// Discs of complex shifts cover the sector from below. The search ends at a frequency below which
/// the wanted number was found and no part of the sector is left where one could be; or, with
/// fewer, far above the frequency where damping in proportion to stiffness overdamps everything.
///
/// @return  those in the sector, ascending in Im lambda; behind them others from the first disc,
///          Im >= 0, nearest to zero first
/// @throws NumericalError  if the sector cannot be covered
QuadraticModes lowest_frequencies(const Sparse& M, const Sparse& D, const Sparse& K,
                                  const FrequencySearch& search);

/// Whether eigenpairs that are all within a disc of real center include every eigenvalue of the
/// sector up to Im lambda = top.
bool covers_sector(double center, double radius, double top, const FrequencySearch& search);

}  // namespace whirl::inline fe
