#pragma once
/// Modes followed over speed.

#include <string>
#include <vector>

#include "libfe/modes.hpp"

namespace whirl {

/// One mode, followed through the speeds by its shape.
struct CampbellBranch {
  Whirl whirl = Whirl::planar;    ///< the sense it has at most speeds other than zero
  std::vector<double> frequency;  ///< damped, per speed [rad/s]; NaN where it does not oscillate
  std::vector<double> log_decrement;  ///< per speed; NaN likewise
};

/// A speed at which a branch meets an excitation line.
struct Crossing {
  double speed = 0.0;  ///< [rad/s]
  int branch = 0;      ///< from 0
};

/// A speed whose modes cannot be computed.
struct CampbellGap {
  double speed = 0.0;  ///< [rad/s]
  std::string why;
};

struct Campbell {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<CampbellBranch> branches;
  std::vector<Crossing> crossings;  ///< with frequency = order * Omega, ascending speed
  std::vector<CampbellGap> gaps;    ///< speeds at which every branch is NaN; most have none
};

/// Modes of a structure over speeds, followed through crossings.
///
/// Modes of neighboring speeds belong together if their shapes agree (MAC weighted with M); where
/// they do not agree well, speeds between are computed too until they do. A speed whose modes cannot
/// be computed is left out and told, and its neighbors are compared with one another.
///
/// @param speeds    ascending, nonnegative [rad/s]
/// @param branches  how many of the lowest modes at the first speed above zero are followed
/// @param order     excitation line whose crossings are reported, 1 for unbalance
/// @throws NumericalError  if modes cannot be computed at any speed
Campbell campbell(const Assembler& assembler, const std::vector<double>& speeds, int branches,
                  double order = 1.0);

/// MAC of two complex shapes with a weight: |a^H W b|^2 / (a^H W a  b^H W b).
double mac(const CVec& a, const CVec& b, const Sparse& W);

}  // namespace whirl
