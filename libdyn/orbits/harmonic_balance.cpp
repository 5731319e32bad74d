#include "libdyn/orbits/harmonic_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/newton.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_halvings = 10;
constexpr int first_harmonics = 10;  ///< a revolution
constexpr double slowest = 0.7;      ///< fall of changes that is believed in
constexpr double unproven = 0.5;     ///< taken for it after one change only
constexpr int most_failures = 3;  ///< numbers of harmonics without an orbit, before it is given up
constexpr double same = 1e-6;     ///< of harmonics that a shorter period does not have, over all

}  // namespace

void HarmonicOptions::check() const {
  if (period < 1 || harmonics < 0 || most_harmonics < 1 || most_steps < 1 || !(tolerance > 0.0) ||
      !(accurate > 0.0)) {
    throw OptionError("harmonic balance: period, harmonics and accuracy must be positive");
  }
  if (harmonics > 0 && harmonics < period) {
    throw OptionError(
        fmt::format("harmonic balance: the speed is harmonic {} of the orbit, there are {}", period,
                    harmonics));
  }
}

Vec HarmonicOrbit::state(int i) const {
  const auto now = motion.at(2.0 * std::numbers::pi * i / motion.period);
  Vec y(2 * now.x.size());
  y << now.x, now.rate;
  return y;
}

int shortest_period(const HarmonicOrbit& orbit) {
  const Mat& c =
      orbit.ports.coefficients.rows() > 0 ? orbit.ports.coefficients : orbit.motion.coefficients;
  const int period = orbit.motion.period;
  for (int p = 1; p < period; ++p) {
    if (period % p != 0) continue;
    double others = 0.0;
    for (Eigen::Index k = 1; k <= c.cols() / 2; ++k) {
      if (k % (period / p) == 0) continue;
      others = std::max(others, c.middleCols(2 * k - 1, 2).cwiseAbs().maxCoeff());
    }
    if (others < same * c.cwiseAbs().maxCoeff()) return p;
  }
  return period;
}

double distance(const Periodic& a, const Periodic& b) {
  const int H = std::max(a.harmonics(), b.harmonics());
  const Periodic between{with_harmonics(a.coefficients, H) - with_harmonics(b.coefficients, H),
                         a.period, a.rate};
  if (between.coefficients.rows() == 0) return 0.0;
  double largest = 0.0;
  const int N = 4 * H + 1;
  for (int i = 0; i < N; ++i) {
    const Vec phi = harmonic_functions(2.0 * std::numbers::pi * i / N, H);
    largest = std::max(largest, (between.coefficients * phi).cwiseAbs().maxCoeff());
  }
  return largest;
}

namespace {

/// Newton's method at one number of harmonics, from displacements at the forces.
HarmonicOrbit solve(const HarmonicEquations& equations, Mat u, const HarmonicOptions& options) {
  const HarmonicProblem& problem = equations.problem();
  struct Balance {
    Mat u;
    HarmonicEvaluation of{};
    double residual = std::numeric_limits<double>::infinity();
  };
  const auto balance = [&](Mat at) {
    Balance b{std::move(at)};
    b.of = equations.evaluate(b.u, false);
    if (!b.of.has_force) return b;
    const bool is_linear = b.of.residual.size() == 0;
    b.residual = is_linear ? 0.0 : b.of.residual.lpNorm<Eigen::Infinity>() / problem.length_scale;
    return b;
  };
  Balance at = balance(std::move(u));
  NewtonSearch search = newton(
      at,
      [&](const Balance& b) {
        return newton_step(equations.jacobian(equations.evaluate(b.u, true)),
                           b.of.residual.reshaped());
      },
      [&](const Balance& b, const Vec& step) {
        return balance(b.u - step.reshaped(b.u.rows(), b.u.cols()));
      },
      {.most_steps = options.most_steps,
       .accurate = options.accurate,
       .most_halvings = most_halvings,
       .worse = 1.0});
  HarmonicOrbit orbit;
  orbit.ports = {at.u, options.period, problem.rate};
  orbit.motion = {equations.motion(at.of.g), options.period, problem.rate};
  orbit.residual = at.residual;
  if (search.end == NewtonEnd::undefined) {
    orbit.failure =
        "no orbit: a force is not defined on the motion, such as that of an oil film "
        "outside its bearing";
  } else if (!search.has_converged()) {
    orbit.failure =
        search.failure("no orbit", "the equations are singular, as where branches meet or turn");
  }
  orbit.residuals = std::move(search.residuals);
  return orbit;
}

}  // namespace

HarmonicOrbit find_harmonic_orbit(const HarmonicProblem& problem, const Mat& start,
                                  const HarmonicOptions& options) {
  options.check();
  const bool is_adaptive = options.harmonics == 0;
  const int most = is_adaptive ? options.most_harmonics * options.period : options.harmonics;
  const int needed = problem.highest_load(options.period);
  if (needed > most) {
    throw OptionError(fmt::format(
        "harmonic balance: a force is harmonic {} of the orbit, there are {}", needed, most));
  }
  int H = std::min(first_harmonics * options.period, most);
  // half as many before, to tell how far the motion still moves
  if (!is_adaptive) H = most >= 4 * options.period ? (most + 1) / 2 : most;
  H = std::max(H, std::min(needed, most));
  HarmonicOrbit found;
  std::vector<HarmonicOrbit::Level> levels;
  double change = std::numeric_limits<double>::quiet_NaN(), fall = unproven;
  int failures = 0;
  for (;; H = std::min(2 * H, most)) {
    const HarmonicEquations equations(problem, options.period, H);
    const bool goes_on = !levels.empty() && found.is_good();
    const Mat from = goes_on ? found.ports.coefficients : equations.U() * start;
    HarmonicOrbit next = solve(equations, with_harmonics(from, H), options);
    if (goes_on && !next.is_good()) {  // from the start again
      HarmonicOrbit again = solve(equations, with_harmonics(equations.U() * start, H), options);
      if (again.is_good()) next = std::move(again);
    }
    const double last = change;
    change = std::numeric_limits<double>::quiet_NaN();
    if (goes_on && next.is_good()) {
      change = distance(next.ports, found.ports) / problem.length_scale;
      fall = std::isfinite(last) && last > 0.0 ? std::clamp(change / last, 0.0, slowest) : unproven;
    }
    levels.push_back({H, static_cast<int>(next.residuals.size()) - 1, change});
    found = std::move(next);
    found.truncation = change * fall / (1.0 - fall);
    if (problem.forces.empty() && H >= options.period) found.truncation = 0.0;  // linear: exact
    failures = found.is_good() ? 0 : failures + 1;
    if (H >= most || failures == most_failures) break;
    if (is_adaptive && found.truncation < options.tolerance) break;
  }
  found.levels = std::move(levels);
  return found;
}

}  // namespace whirl::inline dyn
