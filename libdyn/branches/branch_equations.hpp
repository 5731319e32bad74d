#pragma once
/// What branches of periodic motions solve: multiple shooting, and closed motions of a free period.

#include "libdyn/branches/continuation.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"

namespace whirl::inline dyn {

/// The flow at a value of the parameter; its states are the same throughout.
/// May throw NumericalError where there is none.
using FlowAt = std::function<Flow(double value)>;

/// Derivative of where a flow at a value ends by that value, its start and the phases held; nothing
/// where it is not known. A null function: it never is.
using EndSlopeAt =
    std::function<std::optional<Vec>(double value, const Vec& start, double revolutions)>;

/// Those of multiple shooting, x: states at the starts of the segments, a segment a revolution.
/// @param scale  of the states
BranchEquations shooting_equations(FlowAt flow_at, Vec scale, EndSlopeAt end_slope = {});

/// The walk along periodic orbits of the period asked for.
/// @param start  state near one at the first value, at phase 0
/// @throws NumericalError  if there is none, or no tangent
Continuation orbit_continuation(const FlowAt& flow_at, const Vec& start,
                                const ContinuationOptions& options,
                                const EndSlopeAt& end_slope = {});

/// A flow whose period is free at a value of the parameter; its states are the same throughout.
/// May throw NumericalError where there is none.
using AutonomousFlowAt = std::function<AutonomousFlow(double value)>;

/// Those of an autonomous orbit, x: its state, then its period [revolutions].
///
///   flow(y, T) - y = 0,   <f(y), dy> = 0
///
/// Newton's method moves it across the flow only, and so does its tangent.
/// @param scale  of the states
BranchEquations autonomous_equations(AutonomousFlowAt flow_at, Vec scale,
                                     EndSlopeAt end_slope = {});

/// The walk along closed motions.
/// @param start, period  near one at the first value [states; revolutions]
/// @throws NumericalError  if there is none, or no tangent
Continuation autonomous_continuation(const AutonomousFlowAt& flow_at, const Vec& start,
                                     double period, const ContinuationOptions& options,
                                     const EndSlopeAt& end_slope = {});

}  // namespace whirl::inline dyn
