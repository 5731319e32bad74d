#pragma once
/// The line of a shaft that is bent without any force on it.

#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// The bow at a place, at t = 0.
struct BowState {
  Complex r;      ///< x + i y [m]
  Complex slope;  ///< of it along z [rad]
};

/// The bow at some positions.
///
/// Between the positions of its table it is the natural cubic spline: of all lines through these
/// points the one with the least integral of the curvature squared, as an elastic line has it that
/// is held at these points only. Beyond the ends it goes on straight.
///
/// @param z  positions [m]
/// @return   one per position; none if the shaft is straight
/// @source [StoerBulirsch2002], sec. 2.5
std::vector<BowState> bow_states(const Bow& bow, const std::vector<double>& z);

}  // namespace whirl::inline fe
