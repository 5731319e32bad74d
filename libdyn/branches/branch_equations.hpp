#pragma once
/// Equations of branches of periodic motions: multiple shooting, and motions of a free period.

#include "libdyn/branches/continuation.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"

namespace whirl::inline dyn {

/// The flow at a value of the parameter, with states in the same coordinates at every value. May
/// throw NumericalError where there is no flow.
using FlowAt = std::function<Flow(double value)>;

/// Derivative of the end of a flow by the parameter's value, with the start and the phases held;
/// nothing where the derivative is not known. A null function: it is not known anywhere.
using EndSlopeAt =
    std::function<std::optional<Vec>(double value, const Vec& start, double revolutions)>;

/// Equations of multiple shooting; x: states at the starts of the segments, a segment a revolution.
/// @param scale  of the states
BranchEquations shooting_equations(FlowAt flow_at, Vec scale, EndSlopeAt end_slope = {});

/// The walk along periodic orbits of the period in the options.
/// @param start  state near an orbit at the first value, at phase 0
/// @throws NumericalError  if there is no such orbit, or no tangent
Continuation orbit_continuation(const FlowAt& flow_at, const Vec& start,
                                const ContinuationOptions& options,
                                const EndSlopeAt& end_slope = {});

/// A flow of free period at a value of the parameter, with states in the same coordinates at every
/// value. May throw NumericalError where there is no flow.
using AutonomousFlowAt = std::function<AutonomousFlow(double value)>;

/// Equations of an autonomous orbit; x: its state, then its period [revolutions].
///
///   flow(y, T) - y = 0,   <f(y), dy> = 0
///
/// Newton's method and the tangent of the branch move the state across the flow only.
/// @param scale  of the states
BranchEquations autonomous_equations(AutonomousFlowAt flow_at, Vec scale,
                                     EndSlopeAt end_slope = {});

/// The walk along autonomous orbits.
/// @param start, period  near an orbit at the first value [states; revolutions]
/// @throws NumericalError  if there is no such orbit, or no tangent
Continuation autonomous_continuation(const AutonomousFlowAt& flow_at, const Vec& start,
                                     double period, const ContinuationOptions& options,
                                     const EndSlopeAt& end_slope = {});

}  // namespace whirl::inline dyn
