#include "libdyn/studies/orbit_result.hpp"

namespace whirl::inline dyn {

OrbitResult orbit_result(const Scene& scene, const FoundOrbit& orbit) {
  const StateLayout layout = scene.contacts.layout();
  const Mat map = scene.displacement_map();
  OrbitResult result{.multipliers = orbit.multipliers,
                     .exponents = orbit.exponents,
                     .displacement = Mat(map.rows(), std::ssize(orbit.states)),
                     .period = static_cast<double>(orbit.period),
                     .residual = orbit.residual,
                     .is_stable = orbit.is_stable ? 1 : 0};
  result.velocity = result.displacement;
  for (std::size_t i = 0; i < orbit.states.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.displacement.col(at) = map * layout.eta(orbit.states[i]);
    result.velocity.col(at) = map * layout.rate(orbit.states[i]);
  }
  return result;
}

OrbitResult orbit_result(const Scene& scene, const AutonomousOrbit& cycle) {
  OrbitResult result{.multipliers = cycle.multipliers};
  result.period = cycle.period / scene.contacts.period();
  result.residual = cycle.residual;
  result.is_stable = cycle.is_stable() ? 1 : 0;
  return result;
}

}  // namespace whirl::inline dyn
