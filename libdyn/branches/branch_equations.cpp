#include "libdyn/branches/branch_equations.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libbase/numerics/floquet.hpp"

namespace whirl::inline dyn {

namespace {

/// The same of states over their scale; none of none.
EndSlopeAt over_scale(EndSlopeAt slope, const Vec& scale) {
  if (!slope) return {};
  return [slope = std::move(slope), scale](double value, const Vec& start, double revolutions) {
    auto end = slope(value, scale.cwiseProduct(start), revolutions);
    if (end) *end = end->cwiseQuotient(scale);
    return end;
  };
}

}  // namespace

BranchEquations shooting_equations(FlowAt flow_at, Vec scale, EndSlopeAt end_slope) {
  return {[flow_at = std::move(flow_at), end_slope = over_scale(std::move(end_slope), scale),
           scale](const Vec& x, double value, WithTangent wanted) {
    const Eigen::Index n = scale.size();
    PeriodicOrbit orbit{.period = static_cast<int>(x.size() / n)};
    for (Eigen::Index i = 0; i < x.size(); i += n) {
      orbit.states.emplace_back(scale.cwiseProduct(x.segment(i, n)));
    }
    Flow flow = flow_at(value);
    flow.scale = scale;
    BranchEquations::Value at{.residual = shoot(flow, orbit, wanted)};
    if (wanted == WithTangent::yes && at.residual.size() > 0) {
      at.jacobian = shooting_jacobian(orbit.tangents);
      at.multipliers = [tangents = std::move(orbit.tangents)] { return multipliers_of(tangents); };
      if (end_slope) {
        at.slope = [end_slope, x, value, n]() -> Vec {
          Vec slope(x.size());
          for (Eigen::Index i = 0; i < x.size(); i += n) {
            const auto end = end_slope(value, x.segment(i, n), 1.0);
            if (!end) return {};
            slope.segment(i, n) = *end;
          }
          return slope;
        };
      }
    }
    at.contacts = std::move(orbit.contacts);
    at.failure = std::move(orbit.failure);
    return at;
  }};
}

Continuation orbit_continuation(const FlowAt& flow_at, const Vec& start,
                                const ContinuationOptions& options, const EndSlopeAt& end_slope) {
  options.check();
  const Flow flow = flow_at(options.first);
  require_loads_of_a_revolution(flow);
  const PeriodicOrbit orbit = find_orbit(flow, start, {.period = options.period});
  if (!orbit.is_good()) {
    throw NumericalError(
        fmt::format("at the first value, {:g}: {}", options.first, orbit.failure.text()));
  }
  const Eigen::Index n = flow.scale.size();
  Vec x(n * options.period);
  for (int i = 0; i < options.period; ++i) {
    x.segment(i * n, n) = orbit.states[static_cast<std::size_t>(i)].cwiseQuotient(flow.scale);
  }
  return {shooting_equations(flow_at, flow.scale, end_slope), x, options};
}

BranchEquations autonomous_equations(AutonomousFlowAt flow_at, Vec scale, EndSlopeAt end_slope) {
  return {[flow_at = std::move(flow_at), end_slope = over_scale(std::move(end_slope), scale),
           scale](const Vec& x, double value, WithTangent wanted) {
    const Eigen::Index n = scale.size();
    AutonomousFlow flow = flow_at(value);
    const Vec state = scale.cwiseProduct(x.head(n));
    AutonomousFlow::Result end = flow.go(state, x(n) * flow.revolution, wanted);
    BranchEquations::Value at{.contacts = std::move(end.contacts),
                              .failure = std::move(end.failure)};
    if (at.failure) return at;
    const Vec to_scale = scale.cwiseInverse();
    at.residual = Vec::Zero(n + 1);
    at.residual.head(n) = (end.end - state).cwiseProduct(to_scale);
    if (wanted == WithTangent::no) return at;
    const Mat tangent = to_scale.asDiagonal() * end.tangent * scale.asDiagonal();
    at.multipliers = [tangent] { return multipliers_across(tangent); };
    if (end_slope) {
      at.slope = [end_slope, x, value, n]() -> Vec {
        const auto moved = end_slope(value, x.head(n), x(n));
        if (!moved) return {};
        Vec slope = Vec::Zero(n + 1);  // nothing moves along the flow
        slope.head(n) = *moved;
        return slope;
      };
    }
    at.jacobian =
        autonomous_jacobian(tangent, flow.rate(state).cwiseProduct(to_scale) * flow.revolution,
                            flow.rate(end.end).cwiseProduct(to_scale) * flow.revolution);
    return at;
  }};
}

Continuation autonomous_continuation(const AutonomousFlowAt& flow_at, const Vec& start,
                                     double period, const ContinuationOptions& options,
                                     const EndSlopeAt& end_slope) {
  options.check();
  const AutonomousFlow flow = flow_at(options.first);
  const AutonomousOrbit cycle =
      shorten(flow, find_autonomous_orbit(flow, start, period * flow.revolution));
  if (!cycle.is_good()) {
    throw NumericalError(
        fmt::format("at the first value, {:g}: {}", options.first, cycle.failure.text()));
  }
  Vec x(start.size() + 1);
  x << cycle.state.cwiseQuotient(flow.scale), cycle.period / flow.revolution;
  return {autonomous_equations(flow_at, flow.scale, end_slope), x, options};
}

}  // namespace whirl::inline dyn
