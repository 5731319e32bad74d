#include "libdyn/orbits/shooting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/floquet.hpp"
#include "libbase/numerics/newton.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double worse = 2.0;  ///< growth of the residual that halves a step
constexpr int most_halved_steps = 6;
constexpr double same_state = 1e-6;  ///< of states after a shorter period

/// Sums of what contacts did in the segments, as shares of the whole.
std::vector<ContactMeasure> shares(const std::vector<FlowResult>& passages, double whole) {
  std::vector<ContactTimes> sum = passages.front().contacts;
  for (std::size_t i = 1; i < passages.size(); ++i) {
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c].append(passages[i].contacts[c]);
  }
  return shares_of(sum, whole);
}

/// @throws OptionError  where segments are not as long as the map takes to repeat, or a multiple
void require_repeats(const Flow& flow, int period, int segments) {
  if (period / segments % flow.repeats == 0) return;
  throw OptionError(
      fmt::format("an orbit of period {}: the forces repeat after {} revolutions, so that a period "
                  "is {} or a multiple of it",
                  period, flow.repeats, flow.repeats));
}

}  // namespace

void ShootingOptions::check() const {
  if (period < 1 || most_steps < 1 || segments < 0 || !(accurate > 0.0)) {
    throw OptionError("shooting: period, steps and accuracy must be positive");
  }
  if (segments > 0 && period % segments != 0) {
    throw OptionError(
        fmt::format("shooting: {} segments do not divide a period of {}", segments, period));
  }
}

bool PeriodicOrbit::is_stable() const {
  return is_good() && multipliers.size() > 0 && multipliers.cwiseAbs().maxCoeff() < 1.0;
}

CVec PeriodicOrbit::exponents() const {
  CVec rates = multipliers;
  for (Complex& rate : rates) rate = std::log(rate) / (revolution * period);
  return rates;
}

Mat shooting_jacobian(std::span<const Mat> tangents) {
  const Eigen::Index n = tangents[0].rows(), m = std::ssize(tangents);
  if (m == 1) return tangents[0] - Mat::Identity(n, n);
  Mat J = Mat::Zero(n * m, n * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    J.block(i * n, i * n, n, n) = tangents[static_cast<std::size_t>(i)];
    J.block(i * n, (i + 1) % m * n, n, n).diagonal().array() -= 1.0;
  }
  return J;
}

Vec shoot(const Flow& flow, PeriodicOrbit& orbit, WithTangent wanted) {
  const std::size_t m = orbit.states.size();
  const Eigen::Index n = flow.scale.size();
  if (orbit.period / static_cast<long>(m) % flow.repeats != 0) {
    orbit.failure = fmt::format(
        "the forces repeat after {} revolutions, an orbit of {} in {} parts does not follow them",
        flow.repeats, orbit.period, m);
    orbit.residual = std::numeric_limits<double>::infinity();
    return {};
  }
  const std::vector<FlowResult> passages =
      flow.go(orbit.states, orbit.period / static_cast<long>(m), wanted);
  Vec gaps(n * std::ssize(orbit.states));
  orbit.tangents.clear();
  orbit.revolution = flow.period;
  for (std::size_t i = 0; i < m; ++i) {
    const FlowResult& p = passages[i];
    if (p.failure || !p.end.allFinite() || !p.tangent.allFinite()) {
      orbit.failure = !p.failure ? "the motion or its tangent is not finite" : p.failure;
      orbit.residual = std::numeric_limits<double>::infinity();
      return {};
    }
    gaps.segment(static_cast<Eigen::Index>(i) * n, n) =
        (p.end - orbit.states[(i + 1) % m]).cwiseQuotient(flow.scale);
    if (wanted == WithTangent::no) continue;
    orbit.tangents.push_back(flow.scale.cwiseInverse().asDiagonal() * p.tangent *
                             flow.scale.asDiagonal());
  }
  orbit.failure = {};
  orbit.residual = gaps.lpNorm<Eigen::Infinity>();
  orbit.contacts = shares(passages, flow.period * orbit.period);
  return gaps;
}

PeriodicOrbit find_orbit(const Flow& flow, std::vector<Vec> starts,
                         const ShootingOptions& options) {
  options.check();
  require_repeats(flow, options.period, static_cast<int>(starts.size()));
  const Eigen::Index n = flow.scale.size();
  struct Shot {
    PeriodicOrbit orbit;
    Vec gaps{};
    double residual = 0.0;
  };
  const auto shot = [&](PeriodicOrbit orbit) {
    Shot s{std::move(orbit)};
    s.gaps = shoot(flow, s.orbit);
    s.residual = s.orbit.residual;
    return s;
  };
  Shot at = shot({.period = options.period, .states = std::move(starts)});
  NewtonSearch search = newton(
      at, [](const Shot& s) { return newton_step(shooting_jacobian(s.orbit.tangents), s.gaps); },
      [&](const Shot& s, const Vec& step) {
        PeriodicOrbit next = s.orbit;
        for (std::size_t i = 0; i < next.states.size(); ++i) {
          next.states[i] -=
              flow.scale.cwiseProduct(step.segment(static_cast<Eigen::Index>(i) * n, n));
        }
        return shot(std::move(next));
      },
      {.most_steps = options.most_steps,
       .accurate = options.accurate,
       .most_halvings = most_halved_steps,
       .worse = worse});
  if (search.has_converged()) {
    at.orbit.multipliers = multipliers_of(at.orbit.tangents);
  } else if (search.end != NewtonEnd::undefined) {
    at.orbit.failure = search.failure(
        "no orbit", "a multiplier is one, there the return map has no isolated orbit");
  }
  at.orbit.residuals = std::move(search.residuals);
  return std::move(at.orbit);
}

PeriodicOrbit find_orbit(const Flow& flow, const Vec& start, const ShootingOptions& options) {
  options.check();
  const int revolutions = static_cast<int>(flow.repeats);
  const int segments =
      options.segments > 0 ? options.segments : std::max(1, options.period / revolutions);
  require_repeats(flow, options.period, segments);
  std::vector<Vec> starts{start};
  while (std::ssize(starts) < segments) {
    FlowResult p = flow.go({&starts.back(), 1}, options.period / segments, WithTangent::no).front();
    if (p.failure) {
      PeriodicOrbit orbit{.period = options.period, .revolution = flow.period, .states = starts};
      orbit.residual = std::numeric_limits<double>::infinity();
      orbit.failure = p.failure;
      return orbit;
    }
    starts.push_back(std::move(p.end));
  }
  return find_orbit(flow, std::move(starts), options);
}

int shortest_period(const PeriodicOrbit& orbit, const Vec& scale) {
  const int m = static_cast<int>(orbit.states.size());
  for (int p = 1; p < m; ++p) {
    if (m % p != 0) continue;
    double worst = 0.0;
    for (int i = 0; i < m; ++i) {
      const Vec& a = orbit.states[static_cast<std::size_t>(i)];
      const Vec& b = orbit.states[static_cast<std::size_t>((i + p) % m)];
      worst = std::max(worst, (a - b).cwiseQuotient(scale).lpNorm<Eigen::Infinity>());
    }
    if (worst < same_state) return orbit.period / m * p;
  }
  return orbit.period;
}

}  // namespace whirl::inline dyn
