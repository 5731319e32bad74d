#pragma once

#include "libfe/parts/support.hpp"

namespace whirl::inline fe {

/// Pairs the states of a state space, by the blocks of its real Schur form: both states of a
/// complex pair of poles make a coordinate, and so do two real poles that are not the same. A real
/// pole that is left gets a second state, with an eigenvalue of its own that shows in no force.
///
/// With w = L z and S = [L; L A], z = S^-1 [w; w' - L B u], so that w'' = L A^2 z + L A B u + L B
/// u'. Each coordinate is scaled so that u enters it as strongly as it enters f, which makes the
/// coordinate of a pedestal the displacement of its mass times the root of the mass.
///
/// @throws NumericalError  if the Schur form cannot be computed, or does not tell the states apart
StateCoordinates state_coordinates(const StateSpace& law);

/// States as z = w' + alpha w, one coordinate each, with the eigenvalue -alpha that shows in
/// nothing: what moves a state accelerates its coordinate, so that its rate may jump.
///
///   w'' = A (w' + alpha w) + B u - alpha w'
StateCoordinates followed_states(const StateSpace& law);
/// alpha of these [rad/s].
double following_rate(const StateSpace& law);

/// Those of a support: what it is given, else its states paired; followed where signals saturate.
StateCoordinates state_coordinates(const Support& support);

}  // namespace whirl::inline fe
