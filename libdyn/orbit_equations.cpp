#include "libdyn/orbit_equations.hpp"

#include <utility>

#include "libfe/base/error.hpp"

namespace whirl {

OrbitEquations shooting_equations(FlowAt flow_at, const Vec& scale) {
  return {[flow_at = std::move(flow_at), scale](const Vec& x, double value, Tangents wanted) {
    const Eigen::Index n = scale.size();
    PeriodicOrbit orbit{.period = static_cast<int>(x.size() / n)};
    for (Eigen::Index i = 0; i < x.size(); i += n) {
      orbit.states.emplace_back(scale.cwiseProduct(x.segment(i, n)));
    }
    OrbitEquations::Evaluation result;
    try {
      Flow flow = flow_at(value);
      flow.scale = scale;
      result.residual = shoot(flow, orbit, wanted);
    } catch (const NumericalError& error) {
      orbit.failure = error.what();
    }
    result.failure = orbit.failure;
    result.contacts = std::move(orbit.contacts);
    if (result.residual.size() > 0 && wanted == Tangents::yes) {
      result.jacobian = shooting_jacobian(orbit.tangents);
      result.multipliers = [tangents = std::move(orbit.tangents)] {
        return multipliers_of(tangents);
      };
    }
    return result;
  }};
}

}  // namespace whirl
