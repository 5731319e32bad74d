#pragma once

#include "libfe/eigen/energy_bounds.hpp"
#include "libfe/eigen/quadratic.hpp"

namespace whirl::inline fe {

struct FrequencySearch {
  int count = 0;          ///< eigenvalues wanted in the sector
  double slope = 5.0;     ///< the sector is |Re lambda| < slope * Im lambda
  double center = 0.0;    ///< of the first disc, on the real axis, where K + s D + s^2 M is regular
  EnergyBounds bounds;    ///< leave out where no eigenvalue can be
  int most_discs = 400;   ///< before the search gives up
  bool is_proven = true;  ///< else the first disc that holds so many is the answer
};

/// The eigenpairs of lowest Im lambda within a sector about the imaginary axis, however many others
/// (creeping, overdamped ones) are nearer to zero or between.
///
/// A disc about a real center grows until it holds them and all of the sector below them; where
/// that is too far, discs of complex centers cover the rest. The search ends at a frequency below
/// which the wanted number was found and no part of the sector is left where one could be; or, with
/// fewer, far above the frequency where damping in proportion to stiffness overdamps everything.
///
/// @return  those in the sector, ascending in Im lambda; behind them others from the first disc,
///          Im >= 0, nearest to zero first
/// @throws NumericalError  if the sector cannot be covered
QuadraticModes lowest_frequencies(const Sparse& M, const Sparse& D, const Sparse& K,
                                  const FrequencySearch& search);

}  // namespace whirl::inline fe
