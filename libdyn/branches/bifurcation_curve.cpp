#include "libdyn/branches/bifurcation_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/floquet.hpp"
#include "libbase/roots.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double aside = 2e-7;   ///< of the scales, for differences of test functions
constexpr double hardly = 1e-8;  ///< likewise beside a grazing, where they are smooth on one side
constexpr double none = 1e3;     ///< of a graze where there is no extremum
constexpr int scanned = 8;       ///< parts of a step in which an extremum is looked for
constexpr double sharpest = 1e-15;  ///< of a step, to which it is found

using enum BifurcationKind;

/// Places of the critical multipliers: one, or a complex pair; nothing where there is none.
std::optional<std::pair<Eigen::Index, Eigen::Index>> critical_places(BifurcationKind kind,
                                                                     const CVec& mu) {
  std::optional<std::pair<Eigen::Index, Eigen::Index>> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < mu.size(); ++i) {
    Eigen::Index partner = i;
    double distance = 0.0;
    if (kind == neimark_sacker) {
      if (!(mu(i).imag() > 0.0)) continue;
      (mu.array() - std::conj(mu(i))).abs().minCoeff(&partner);
      distance = std::abs(std::abs(mu(i)) - 1.0);
    } else {
      distance = std::abs(mu(i) - (kind == period_doubling ? -1.0 : 1.0));
    }
    if (distance < nearest) {
      nearest = distance;
      found = {i, partner};
    }
  }
  return found;
}

std::optional<double> test_value(BifurcationKind kind, const CVec& mu) {
  const auto at = critical_places(kind, mu);
  if (!at) return std::nullopt;
  const Complex m = mu(at->first);
  if (kind == neimark_sacker) return std::norm(m) - 1.0;
  if (m.imag() != 0.0) return std::nullopt;  // it has met another one
  return m.real() + (kind == period_doubling ? 1.0 : -1.0);
}

/// What the equations of a curve are made of. Their unknowns x are states [scales], then u.
struct BifurcationCurve {
  BifurcationKind kind;
  FlowPlane flows;
  Vec scale;
  double low, high;  ///< first parameter where u is 0 and 1

  double difference() const { return kind == grazing ? hardly : aside; }
  double first(const Vec& x) const { return low + x(x.size() - 1) * (high - low); }
  std::vector<Vec> states(const Vec& x) const {
    std::vector<Vec> states;
    for (Eigen::Index i = 0; i + scale.size() < x.size(); i += scale.size()) {
      states.emplace_back(scale.cwiseProduct(x.segment(i, scale.size())));
    }
    return states;
  }
  double graze(const Vec& x, double second) const {
    return flows.graze(first(x), second, states(x));
  }
};

/// Gaps and g at a place; empty where one of them fails.
struct Place {
  PeriodicOrbit orbit;
  Vec residual;
  Failure failure;
};
Place place_at(const BifurcationCurve& curve, const Vec& x, double second) {
  Place p;
  p.orbit.states = curve.states(x);
  p.orbit.period = static_cast<int>(p.orbit.states.size());
  Flow flow = curve.flows.at(curve.first(x), second);
  flow.scale = curve.scale;
  const Vec gaps = shoot(flow, p.orbit);
  p.failure = p.orbit.failure;
  if (gaps.size() == 0) return p;
  const std::optional<double> g = curve.kind == grazing
                                      ? curve.graze(x, second)
                                      : test_value(curve.kind, multipliers_of(p.orbit.tangents));
  if (!g) {
    p.failure = curve.kind == neimark_sacker ? "the critical pair becomes real: a strong resonance"
                                             : "the critical multiplier meets another one";
    return p;
  }
  p.residual.resize(gaps.size() + 1);
  p.residual << gaps, *g;
  return p;
}

/// dg / dx of a grazing by the states, each difference towards the motion that does not touch.
Vec graze_slopes(const BifurcationCurve& curve, const Vec& x, double second, double g) {
  const double h = curve.difference();
  Vec slopes(x.size() - 1);
  for (Eigen::Index k = 0; k < slopes.size(); ++k) {
    Vec moved = x;
    moved(k) = x(k) + h;
    const double above = curve.graze(moved, second);
    moved(k) = x(k) - h;
    const double below = curve.graze(moved, second);
    slopes(k) = above < below ? (above - g) / h : (g - below) / h;
  }
  return slopes;
}

/// dg / dx of a critical multiplier by the states, each of which moves one segment only; nothing where
/// a moved one has no g.
std::optional<Vec> multiplier_slopes(const BifurcationCurve& curve, const Vec& x, double second,
                                     const Place& here) {
  const Vec& scale = curve.scale;
  const Eigen::Index size = x.size() - 1, n = scale.size();
  const double h = curve.difference(), g = here.residual(size);
  std::vector<Vec> starts;
  for (Eigen::Index k = 0; k < size; ++k) {
    starts.push_back(here.orbit.states[static_cast<std::size_t>(k / n)]);
    starts.back()(k % n) += h * scale(k % n);
  }
  const auto passages = curve.flows.at(curve.first(x), second).go(starts, 1, WithTangent::yes);
  Vec slopes(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const FlowResult& p = passages[static_cast<std::size_t>(k)];
    if (p.failure) return std::nullopt;
    std::vector<Mat> tangents = here.orbit.tangents;
    tangents[static_cast<std::size_t>(k / n)] =
        scale.cwiseInverse().asDiagonal() * p.tangent * scale.asDiagonal();
    const auto moved = test_value(curve.kind, multipliers_of(tangents));
    if (!moved) return std::nullopt;
    slopes(k) = (*moved - g) / h;
  }
  return slopes;
}

/// The multipliers that are not critical.
CVec other_multipliers(BifurcationKind kind, const std::vector<Mat>& tangents) {
  const CVec all = multipliers_of(tangents);
  if (kind == grazing) return all;
  const auto critical = critical_places(kind, all);
  std::vector<Complex> others;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (!critical || (i != critical->first && i != critical->second)) others.push_back(all(i));
  }
  return Eigen::Map<const CVec>(others.data(), std::ssize(others));
}

BranchEquations::Value evaluate(const BifurcationCurve& curve, const Vec& x, double second,
                                WithTangent wanted) {
  const Eigen::Index size = x.size() - 1;
  const double h = curve.difference();
  if (x(size) < 0.0 || x(size) > 1.0) return {.failure = "the range of the first parameter ends"};
  Place here = place_at(curve, x, second);
  BranchEquations::Value at{
      .residual = here.residual, .contacts = here.orbit.contacts, .failure = here.failure};
  if (curve.kind == grazing) {  // whether it touches is rounding here
    for (ContactMeasure& c : at.contacts) c.impacts = 0.0;
  }
  if (wanted == WithTangent::no || at.residual.size() == 0) return at;
  at.jacobian = Mat::Zero(size + 1, size + 1);
  at.jacobian.topLeftCorner(size, size) = shooting_jacobian(here.orbit.tangents);
  Vec moved = x;
  moved(size) = x(size) + h;
  const Place beside = place_at(curve, moved, second);
  moved(size) = x(size) - h;
  const Place before = place_at(curve, moved, second);
  if (beside.residual.size() == 0 || before.residual.size() == 0) {
    return {.failure = beside.failure ? beside.failure : before.failure};
  }
  at.jacobian.col(size) = (beside.residual - before.residual) / (2.0 * h);
  const std::optional<Vec> slopes = curve.kind == grazing
                                        ? graze_slopes(curve, x, second, here.residual(size))
                                        : multiplier_slopes(curve, x, second, here);
  if (!slopes) return {.failure = "beside it there is no such point"};
  at.jacobian.row(size).head(size) = slopes->transpose();
  at.multipliers = [kind = curve.kind, tangents = std::move(here.orbit.tangents)] {
    return other_multipliers(kind, tangents);
  };
  return at;
}

/// Depth over clearance at the extremum of a step that is nearest to touching.
double nearest_graze(const ContactSystem& system, const ReducedContact& c, const Step& step) {
  Vec y(system.size());
  const auto at = [&](double s) {
    step.at(s, y.data());
    return kinematics(c, step.phase + s * step.turn, y.data(), system.coordinates());
  };
  const auto rate_at = [&](double s) { return at(s).rate; };
  double nearest = none, before = rate_at(0.0);
  for (int k = 1; k <= scanned; ++k) {
    const double low = double(k - 1) / scanned, high = double(k) / scanned, after = rate_at(high);
    if ((after > 0.0) != (before > 0.0)) {
      const double s = bracketed_root(rate_at, low, before, high, after, sharpest);
      const double depth = at(s).depth / c.clearance;
      if (std::abs(depth) < std::abs(nearest)) nearest = depth;
    }
    before = after;
  }
  return nearest;
}

}  // namespace

BranchEquations bifurcation_curve_equations(BifurcationKind kind, FlowPlane flows, Vec scale,
                                            double low, double high) {
  if (kind == pitchfork) {
    throw NumericalError("a pitchfork lives by a symmetry and has no curve of its own in a plane");
  }
  const BifurcationCurve curve{kind, std::move(flows), std::move(scale), low, high};
  return {.at = [curve](const Vec& x, double second,
                        WithTangent wanted) { return evaluate(curve, x, second, wanted); },
          .difference = curve.difference()};
}

double nearest_graze(const Scene& scene, const std::string& contact, std::span<const Vec> starts) {
  const ContactSystem& system = scene.contacts;
  double nearest = none;
  for (const Vec& start : starts) {
    Trajectory t{.system = &system, .revolutions = 1};
    t.state.y = start;
    integrate_single(t, {.tolerance = flow_tolerance}, [&](const Step& step) {
      for (const ReducedContact& c : system.contacts()) {
        if (!contact.empty() && c.name != contact) continue;
        const double depth = nearest_graze(system, c, step);
        if (std::abs(depth) < std::abs(nearest)) nearest = depth;
      }
      return true;
    });
  }
  return nearest;
}

}  // namespace whirl::inline dyn
