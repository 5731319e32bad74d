#include "libfe/critical.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libfe/base/error.hpp"
#include "libfe/campbell.hpp"
#include "libfe/eigen/hermitian.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/static.hpp"

namespace whirl {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double speed_tol = 1e-12;

std::vector<Critical> of_pencil(const System& system, const CriticalOptions& options) {
  const Sparse K = symmetric_part(system.K);
  const HermitianModes modes =
      largest_hermitian(system.M, system.G, 1.0 / options.order, K, options.count);
  std::vector<Critical> criticals;
  for (Eigen::Index i = 0; i < modes.nu.size(); ++i) {
    if (modes.nu(i) <= 0.0) break;  // no real speed: a disk that stiffens faster than it spins
    const CVec q = modes.q.col(i);
    criticals.push_back(
        {1.0 / (options.order * std::sqrt(modes.nu(i))), nan, whirl_of(orbits(system.dofs, q)), q});
  }
  return criticals;
}

/// Iterates the i-th critical speed of the stiffness at Omega until it is Omega itself.
Critical self_consistent(const Assembler& assembler, const CriticalOptions& options, std::size_t i,
                         Critical start) {
  const auto at = [&](double Omega) {
    std::vector<Critical> all = of_pencil(assembler.at(Omega), options);
    return i < all.size() ? all[i] : Critical{.speed = nan};
  };
  double a = start.speed;
  Critical at_a = at(a);
  double b = at_a.speed;
  for (int it = 0; it < 100 && std::isfinite(b); ++it) {
    const Critical at_b = at(b);
    if (std::abs(at_b.speed - b) <= speed_tol * b) return at_b;
    const double slope = (at_b.speed - at_a.speed) / (b - a);  // of the map Omega -> critical
    double next = at_b.speed;
    if (std::abs(slope) < 0.9) next = b + (at_b.speed - b) / (1.0 - slope);
    a = b;
    at_a = at_b;
    b = next;
  }
  start.speed = nan;
  return start;
}

/// Solves Im lambda(Omega) = order * Omega from an undamped critical speed; NaN: the mode is lost.
double damped_speed(const ModeFinder& finder, const Critical& undamped,
                    const CriticalOptions& options) {
  CVec shape = undamped.shape;
  const auto gap = [&](double Omega) {
    const Sparse M = finder.system(Omega).M;
    const Modes modes = finder.at(Omega, options.count + 6);
    double best = 0.3;
    double result = nan;
    CVec best_shape = shape;
    for (const Mode& mode : modes.oscillatory) {
      const double agreement = mac(mode.shape, shape, M);
      if (agreement <= best) continue;
      best = agreement;
      best_shape = mode.shape;
      result = mode.frequency() - options.order * Omega;
    }
    shape = best_shape;
    return result;
  };
  double a = undamped.speed, ga = gap(a);
  if (std::abs(ga) <= 1e-10 * a) return a;
  double b = a + ga / options.order * 0.5, gb = gap(b);
  for (int it = 0; it < 60; ++it) {
    if (!std::isfinite(ga) || !std::isfinite(gb)) return nan;
    if (std::abs(gb) <= 1e-10 * b) return b;
    if (gb == ga) return nan;
    const double next = b - gb * (b - a) / (gb - ga);
    if (!(next > 0.2 * undamped.speed && next < 5.0 * undamped.speed)) return nan;
    a = b, ga = gb;
    b = next, gb = gap(b);
  }
  return nan;
}

}  // namespace

std::vector<Critical> undamped_criticals(const System& system, const CriticalOptions& options) {
  return of_pencil(system, options);
}

std::vector<Critical> critical_speeds(const Assembler& assembler, const CriticalOptions& options) {
  require_supports(assembler, 0.0, "critical speeds need");
  std::vector<Critical> criticals = of_pencil(assembler.at(0.0), options);
  if (assembler.depends_on_speed()) {
    std::vector<Critical> iterated;
    for (std::size_t i = 0; i < criticals.size(); ++i) {
      const Critical c = self_consistent(assembler, options, i, criticals[i]);
      if (std::isfinite(c.speed)) iterated.push_back(c);
    }
    criticals = std::move(iterated);
    std::sort(criticals.begin(), criticals.end(),
              [](const Critical& a, const Critical& b) { return a.speed < b.speed; });
  }
  const ModeFinder finder(assembler);
  for (Critical& c : criticals) c.damped_speed = damped_speed(finder, c, options);
  return criticals;
}

}  // namespace whirl
