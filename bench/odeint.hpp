#pragma once
/// The rotor and stator of tests/support/scenes.hpp as a user of Boost.odeint would write them.

#include "libdyn/motions/work_precision.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {

/// Boost.odeint's controlled runge_kutta_dopri5, both of its tolerances the one given, relative
/// and, times the scales of the state, absolute: the equations are written without dimensions.
///
/// @param rotor  its parameters; friction that switches with the slip, contact without damping
Candidate odeint_candidate(const test::RotorStator& rotor);

}  // namespace whirl
