#include "libio/results/orbit_results.hpp"

#include "libio/results/hdf5.hpp"

namespace whirl {

namespace {

void write_orbit_series(ResultWriter& file, const OrbitSeries& series) {
  file.dataset("/orbit/order", series.orders, {"", "frequency over speed", {""}});
  file.dataset("/orbit/amplitude", series.amplitudes,
               {"m, rad",
                "displacement of all points is Re sum amplitude e^(i order phase)",
                {"", "/orbit/order"}});
  file.attribute("/orbit", "truncation", series.truncation);
}

void write_multipliers(ResultWriter& file, const CVec& multipliers) {
  file.dataset("/orbit/multiplier", multipliers,
               {"", "Floquet multipliers of the period, the largest first", {""}});
}

}  // namespace

void write_orbit(ResultWriter& file, const Scene& scene, const FoundOrbit& orbit) {
  const auto n = scene.contacts.coordinates();
  const Mat map = scene.displacement_map();
  Mat displacements(map.rows(), std::ssize(orbit.states)), velocities = displacements;
  for (std::size_t i = 0; i < orbit.states.size(); ++i) {
    displacements.col(static_cast<Eigen::Index>(i)) = map * orbit.states[i].head(n);
    velocities.col(static_cast<Eigen::Index>(i)) = map * orbit.states[i].tail(n);
  }
  write_multipliers(file, orbit.multipliers);
  file.dataset("/orbit/exponent", orbit.exponents,
               {"1/s", "Floquet exponents, log(multiplier) / period", {"/orbit/multiplier"}});
  file.dataset("/orbit/displacement", displacements,
               {"m, rad", "displacement of all points at the starts of revolutions", {"", ""}});
  file.dataset("/orbit/velocity", velocities,
               {"m/s, rad/s", "velocity of all points at the starts of revolutions", {"", ""}});
  file.attribute("/orbit", "period_revolutions", orbit.period);
  file.attribute("/orbit", "residual", orbit.residual);
  file.attribute("/orbit", "stable", orbit.is_stable ? 1 : 0);
  if (orbit.series) write_orbit_series(file, *orbit.series);
}

void write_rotating_orbit(ResultWriter& file, const Scene& scene, const Cycle& cycle) {
  write_multipliers(file, cycle.multipliers);
  file.attribute("/orbit", "period_revolutions", cycle.period / scene.contacts.period());
  file.attribute("/orbit", "residual", cycle.residual);
  file.attribute("/orbit", "stable", cycle.is_stable() ? 1 : 0);
}

}  // namespace whirl
