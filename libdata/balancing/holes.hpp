#pragma once
/// Correction weights as pieces in holes at fixed angles.

#include <cmath>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// The places of a plane that weights can be put into.
struct BalancingHoles {
  Vec angles;  ///< in the direction of rotation from the mark [rad]
  std::vector<double>
      pieces{};             ///< masses that there are, any number of each; empty: any mass [kg]
  int pieces_per_hole = 1;  ///< that fit into a hole, at most
  double most = INFINITY;   ///< that a hole can carry [kg]
};

/// Masses in the holes whose sum is near to a weight [kg].
///
/// Of any masses the sum is the nearest one, and the total as small as it can be: two neighbors that
/// the weight lies between share it after the sine rule, where these can carry it. Pieces go into
/// the fewest holes whose sum is nearer than half of the smallest piece. Where three holes, beside
/// those that are full, come no nearer, no change of what is in three holes brings the sum nearer,
/// or in two holes where more than 2e7 such changes would be tried.
///
/// @param holes   one or more
/// @param weight  m e^(i angle) [kg]
/// @return        per hole [kg]
Vec split_over_holes(const BalancingHoles& holes, Complex weight);

}  // namespace whirl::inline data
