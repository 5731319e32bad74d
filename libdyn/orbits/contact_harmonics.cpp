#include "libdyn/orbits/contact_harmonics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdyn/methods/methods.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/system/contact_ports.hpp"
#include "libdyn/system/require_coordinates.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int first_samples = 256;  ///< of a revolution, for a start
constexpr int kept = 80;            ///< harmonics of them

}  // namespace

HarmonicProblem harmonic_problem(const ContactSystem& system) {
  require_coordinates(system);
  orbit_abilities.require(system);
  std::vector<HarmonicProblem::Load> loads;
  for (const ReducedExcitation& e : system.excitations()) {
    loads.push_back({e.order, e.cosine, e.sine});
  }
  return {.K = system.K(),
          .D = system.D(),
          .loads = std::move(loads),
          .rate = system.phase_rate(),
          .length_scale = system.length_scale(),
          .scale = system.state_scale(),
          .forces = port_forces(system),
          .measures = [&system](const Periodic& motion) { return measures_on(system, motion); }};
}

HarmonicProblem harmonic_slope(const ContactSystem& system, const NumberSlopes& slopes) {
  using S = ContactSystem;
  HarmonicProblem by{.K = slopes.of([](const S& s) -> const Mat& { return s.K(); }),
                     .D = slopes.of([](const S& s) -> const Mat& { return s.D(); }),
                     .rate = slopes.of([](const S& s) { return s.phase_rate(); }),
                     .length_scale = 0.0,
                     .scale = {},
                     .forces = port_force_slopes(system, slopes),
                     .measures = {}};
  for (std::size_t i = 0; i < system.excitations().size(); ++i) {
    by.loads.push_back(
        {system.excitations()[i].order,
         slopes.of([i](const S& s) -> const Vec& { return s.excitations()[i].cosine; }),
         slopes.of([i](const S& s) -> const Vec& { return s.excitations()[i].sine; })});
  }
  return by;
}

Mat harmonic_start(const ContactSystem& system, const Vec& y, int revolutions) {
  const StateLayout layout = system.layout();
  const Eigen::Index N = static_cast<Eigen::Index>(first_samples) * revolutions;
  Mat eta = layout.eta(y).replicate(1, N);
  MotionState state;
  state.y = y;
  Eigen::Index next = 0;
  Vec now(layout.size());
  integrate(suitable_method(system), system, state, revolutions, {}, [&](const Step& step) {
    const double begin = turn * static_cast<double>(step.revolution) + step.phase;
    for (; next < N; ++next) {
      const double phase = turn * static_cast<double>(next) / first_samples;
      if (phase > begin + step.turn()) break;
      step.at(step.after_turn(phase - begin), now.data());
      eta.col(next) = layout.eta(now);
    }
    return true;
  });
  return fourier_coefficients(eta, kept * revolutions);
}

ContactOrbit find_harmonic_orbit(const ContactSystem& system, const Vec& y,
                                 const HarmonicOptions& options) {
  options.check();
  const HarmonicProblem problem = harmonic_problem(system);
  ContactOrbit found;
  found.orbit = find_harmonic_orbit(problem, harmonic_start(system, y, options.period), options);
  HarmonicOrbit& orbit = found.orbit;
  if (!orbit.is_good()) return found;
  const std::string sticking = sticks_on(system, orbit.motion);
  if (!sticking.empty()) {
    orbit.failure = fmt::format(
        "no orbit: contact \"{}\" would stick where its slip changes sign, which harmonic balance "
        "does not know; give it a slip_tolerance, or use shooting",
        sticking);
  }
  found.contacts = measures_on(system, orbit.motion);
  return found;
}

}  // namespace whirl::inline dyn
