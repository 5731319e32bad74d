#include "libdyn/studies/proven_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/newton.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/taylor/mixed.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double same_motion = 1e-6;  ///< of a shorter period that Newton's orbit has, too
constexpr double exact = 1e-12;       ///< tolerance of steps for an orbit and its multipliers
constexpr int most_newton = 8;

/// A step of Newton's method; false: this leads nowhere.
bool improve(OrbitCandidate& c, const Trajectory& t, bool is_patient) {
  const ContactSystem& system = *c.of->system;
  if (t.outcome != Outcome::reached_end || !t.tangent.allFinite()) return false;
  const Mat unscale = system.state_scale().asDiagonal();
  const Mat to_scale = system.state_scale().cwiseInverse().asDiagonal();
  const double before = c.residual;
  c.residual = distance(system, t.state.y, c.y);
  const Mat tangent = to_scale * t.tangent * unscale;
  if (has_converged(c.residual, before)) {
    const Vec sizes = eigenvalues(tangent).cwiseAbs();
    if (!(sizes.maxCoeff() < largest_attracting)) return false;
    if (distance(system, c.y, c.of->found.end.y) > c.farthest) return false;  // another one
    Vec exponents = sizes.array().max(1e-300).log() / c.period;
    std::sort(exponents.begin(), exponents.end(), std::greater<>());
    c.exponents = exponents;
    const int step = static_cast<int>(system.repeats_after());
    for (int p = step; p < c.period; p += step) {  // it may have a shorter period
      const Eigen::Map<const Vec> section(t.sections.data() + (p - 1) * system.size(),
                                          system.size());
      if (c.period % p == 0 && distance(system, section, c.y) < same_motion) c.period = p;
    }
    return true;
  }
  if (c.residual > (is_patient ? 10.0 : 0.1) * before) return false;
  const auto correction = newton_step(shooting_jacobian({&tangent, 1}),
                                      (t.state.y - c.y).cwiseQuotient(system.state_scale()));
  if (!correction) return false;
  c.y -= system.state_scale().cwiseProduct(*correction);
  return true;
}

}  // namespace

int repeating_period(const ContactSystem& system, const std::vector<double>& sections, double bound,
                     int longest) {
  const int size = system.size(), count = static_cast<int>(sections.size()) / size;
  const auto section = [&](int i) -> Vec {
    return Eigen::Map<const Vec>(sections.data() + i * size, size);
  };
  const int step = static_cast<int>(system.repeats_after());
  if (step == 0) return 0;
  for (int p = step; p <= std::min(longest, count / 2); p += step) {
    double worst = 0.0;
    for (int i = count - p; i < count && worst < bound; ++i) {
      worst = std::max(worst, distance(system, section(i), section(i - p)));
    }
    if (worst < bound) return p;
  }
  return 0;
}

void find_orbits(std::vector<OrbitCandidate>& candidates, double tolerance,
                 const std::function<bool(long)>& watch, bool is_patient) {
  std::vector<OrbitCandidate> found;
  for (int iteration = 0; iteration < most_newton && !candidates.empty(); ++iteration) {
    std::vector<Trajectory> returns;
    for (const OrbitCandidate& c : candidates) {
      returns.push_back(
          {.system = c.of->system,
           .state = {.revolution = c.of->found.end.revolution, .phase = 0.0, .y = c.y},
           .revolutions = c.period});
    }
    BatchOptions how{
        .tolerance = std::min(tolerance, exact), .threads = 1, .sections = true, .tangent = true};
    how.watch = watch;
    integrate_mixed(returns, how);
    std::vector<OrbitCandidate> further;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!improve(candidates[i], returns[i], is_patient)) continue;
      (candidates[i].exponents ? found : further).push_back(std::move(candidates[i]));
    }
    candidates = std::move(further);
  }
  candidates = std::move(found);
}

bool stands_still(const ClassifyCandidate& s, double tolerance) {
  const ContactSystem& system = *s.system;
  if (!system.synchronous_load().is_zero() || !system.other_loads().empty()) return false;
  double moved = 0.0;
  Trajectory t{.system = s.system, .state = s.found.end, .revolutions = 1};
  Vec y(system.size());
  integrate_single(t, {.tolerance = tolerance}, [&](const Step& step) {
    for (const double place : {0.5, 1.0}) {
      step.at(place, y.data());
      moved = std::max(moved, distance(system, y, s.found.end.y));
    }
    return true;
  });
  return t.outcome == Outcome::reached_end && moved < same_motion;
}

}  // namespace whirl::inline dyn
