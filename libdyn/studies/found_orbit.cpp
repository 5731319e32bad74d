#include "libdyn/studies/found_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libdyn/motions/transient.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/hill.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

/// States at the starts of all revolutions, from those at the starts of segments.
std::vector<Vec> every_revolution(const ContactSystem& system, const PeriodicOrbit& orbit) {
  const auto segments = std::ssize(orbit.states);
  if (segments == orbit.period || !orbit.is_good()) return orbit.states;
  std::vector<Vec> states;
  for (const Vec& start : orbit.states) {
    Trajectory t{.system = &system, .revolutions = orbit.period / segments - 1};
    t.state.y = start;
    integrate_single(t, {.tolerance = flow_tolerance, .sections = true});
    if (t.outcome != Outcome::reached_end) return orbit.states;
    states.push_back(start);
    for (long i = 0; i < t.revolutions; ++i) {
      states.emplace_back(
          Eigen::Map<const Vec>(t.sections.data() + i * start.size(), start.size()));
    }
  }
  return states;
}

FoundOrbit find_by_shooting(const Scene& scene, const Vec& start, int period) {
  const Flow flow = flow_of(scene.contacts);
  PeriodicOrbit orbit = find_orbit(flow, start, {.period = period});
  FoundOrbit found{.period = period, .shortest_period = period};
  found.residual = orbit.residual;
  found.steps = std::max(1L, std::ssize(orbit.residuals)) - 1;
  found.states = every_revolution(scene.contacts, orbit);
  found.multipliers = orbit.multipliers;
  found.contacts = orbit.contacts;
  found.failure = orbit.failure;
  if (!orbit.is_good()) return found;
  found.shortest_period = shortest_period(orbit, flow.scale);
  found.exponents = orbit.exponents();
  found.is_stable = orbit.is_stable();
  found.modes = modes_of_multipliers(scene, orbit);
  found.probes = probes_along(scene, found.state(), period);
  return found;
}

ShootingGap gap_of(const Scene& scene, const FoundOrbit& orbit) {
  const ContactSystem& system = scene.contacts;
  const StateLayout layout = system.layout();
  const Flow flow = flow_of(system);
  const auto stride = static_cast<std::size_t>(flow.repeats);
  std::vector<Vec> starts;
  for (std::size_t i = 0; i < orbit.states.size(); i += stride) starts.push_back(orbit.states[i]);
  const PeriodicOrbit shot = find_orbit(flow, starts, {.period = orbit.period});
  if (!shot.is_good()) return {.failure = shot.failure};
  double displacement = 0.0, velocity = 0.0, multiplier = 0.0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Vec gap = (starts[i] - shot.states[i]).cwiseQuotient(system.state_scale()).cwiseAbs();
    displacement = std::max(displacement, layout.eta(gap).maxCoeff());
    velocity = std::max(velocity, layout.rate(gap).maxCoeff());
  }
  for (const Complex& m : orbit.multipliers) {
    const Vec gap = (shot.multipliers.array() - m).abs();
    multiplier = std::max(multiplier, gap.minCoeff());
  }
  return {.displacement = displacement,
          .velocity = velocity,
          .multiplier = multiplier,
          .residual = shot.residual};
}

/// Amplitudes of all points.
void add_amplitudes(const Scene& scene, const HarmonicOrbit& orbit, OrbitSeries& series) {
  const Mat full = scene.displacement_map() * orbit.motion.coefficients;
  series.orders.resize(orbit.harmonics() + 1);
  series.amplitudes.resize(full.rows(), series.orders.size());
  series.orders(0) = 0.0;
  series.amplitudes.col(0) = full.col(0).cast<Complex>();
  for (Eigen::Index k = 1; k < series.orders.size(); ++k) {
    series.orders(k) = static_cast<double>(k) / orbit.motion.period;
    series.amplitudes.col(k) = full.col(2 * k - 1) - Complex(0.0, 1.0) * full.col(2 * k);
  }
}

FoundOrbit find_by_harmonic_balance(const Scene& scene, const Vec& start,
                                    const OrbitOptions& options) {
  const ContactOrbit at = find_harmonic_orbit(
      scene.contacts, start, {.period = options.period, .harmonics = options.harmonics});
  const HarmonicOrbit& orbit = at.orbit;
  FoundOrbit found{.period = options.period, .shortest_period = options.period};
  found.residual = orbit.residual;
  found.failure = orbit.failure;
  for (const HarmonicOrbit::Level& level : orbit.levels) found.steps += level.steps;
  for (int i = 0; i < options.period; ++i) found.states.push_back(orbit.state(i));
  found.series = OrbitSeries{
      .harmonics = orbit.harmonics(), .truncation = orbit.truncation, .levels = orbit.levels};
  if (!orbit.is_good()) return found;
  found.contacts = at.contacts;
  found.shortest_period = shortest_period(orbit);
  const HillStability hill = hill_stability(harmonic_problem(scene.contacts), orbit);
  found.multipliers = hill.multipliers;
  found.exponents = hill.exponents;
  found.is_stable = hill.is_stable();
  found.series->missing_multipliers = hill.missing;
  found.series->averaged_multipliers = hill.averaged;
  found.series->stability_failure = hill.failure;
  add_amplitudes(scene, orbit, *found.series);
  found.probes = probes_along(scene, orbit.motion);
  if (options.is_verified) found.series->gap = gap_of(scene, found);
  return found;
}

}  // namespace

std::optional<bool> FoundOrbit::stability() const {
  return is_good() ? std::optional(is_stable) : std::nullopt;
}

std::vector<ContactShare> FoundOrbit::contact_shares() const {
  return whirl::contact_shares(contacts, period).contacts;
}

long RotatingOrbit::steps() const {
  return std::max(1L, std::ssize(residuals)) - 1;
}

std::optional<bool> RotatingOrbit::stability() const {
  return is_good() ? std::optional(is_stable()) : std::nullopt;
}

FoundOrbit find_orbit_near(const Scene& scene, const Vec& start, const OrbitOptions& options) {
  return options.method == OrbitMethod::shooting ? find_by_shooting(scene, start, options.period)
                                                 : find_by_harmonic_balance(scene, start, options);
}

FoundOrbit find_orbit_after(const Trajectory& transient, const Scene& scene,
                            const OrbitOptions& options) {
  Trajectory end = transient;
  if (end.outcome == Outcome::reached_end) {  // an orbit begins where forces do
    end.revolutions = until_forces_repeat(scene.contacts, end.state.revolution);
    if (end.revolutions > 0) integrate_single(end, {.tolerance = flow_tolerance});
  }
  if (end.outcome == Outcome::reached_end) return find_orbit_near(scene, end.state.y, options);
  return {.period = options.period,
          .shortest_period = options.period,
          .states = {end.state.y},
          .failure = !end.failure ? "stopped in the transient" : end.failure};
}

double guessed_period(const Scene& scene, const Vec& start) {
  const auto guess = recurrence(scene, start, most_recurrence);
  if (guess) return *guess;
  throw NumericalError(
      fmt::format("the motion does not come back within {} revolutions as seen from the rotor, or "
                  "stands still there",
                  most_recurrence));
}

RotatingOrbit find_rotating_orbit(const AutonomousFlow& flow, const Scene& scene,
                                  const Vec& start) {
  const AutonomousOrbit cycle =
      shorten(flow, find_autonomous_orbit(flow, start, guessed_period(scene, start)));
  RotatingOrbit found{cycle, cycle.period / scene.contacts.period()};
  if (found.is_good()) {
    found.probes = probes_along(scene, found.state, found.revolutions, OrbitFrame::rotating);
  }
  return found;
}

}  // namespace whirl::inline dyn
