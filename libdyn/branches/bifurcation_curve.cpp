#include "libdyn/branches/bifurcation_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/floquet.hpp"
#include "libbase/numerics/roots.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double aside = 2e-7;   ///< of the scales, for differences of test functions
constexpr double hardly = 1e-8;  ///< likewise beside a grazing, where they are smooth on one side
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
  NearestGraze graze(const Vec& x, double second) const {
    return flows.graze(first(x), second, states(x));
  }
};

/// Gaps and g at a place; empty where one of them fails.
struct Place {
  PeriodicOrbit orbit;
  NearestGraze graze;  ///< of a grazing
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
  if (curve.kind == grazing) p.graze = curve.graze(x, second);
  const std::optional<double> g = curve.kind == grazing
                                      ? p.graze.depth
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

/// Derivatives of gaps and g by the first parameter u, or the second one itself, and of g by the
/// states.
struct Slopes {
  Vec by_parameter;
  Vec by_states;  ///< if asked for
};

/// The critical multiplier, and what its eigenvectors are in every segment, in scales.
struct Critical {
  Complex multiplier;
  std::vector<CVec> right;  ///< v, at the start
  std::vector<CVec> left;   ///< w at the end, for w^T v = 1 of the period

  /// Change of g with a change of a deviation at the end of a segment.
  double change(BifurcationKind kind, std::size_t segment, const CVec& end) const {
    const Complex of_multiplier = left[segment].transpose() * end;
    if (kind != neimark_sacker) return of_multiplier.real();
    return 2.0 * (std::conj(multiplier) * of_multiplier).real();
  }
};

/// The eigenvector of a value that is nearest to one.
std::optional<CVec> eigenvector(const Mat& A, Complex value) {
  const auto modes = general_modes(A);
  if (!modes) return std::nullopt;
  Eigen::Index at = 0;
  (modes->values.array() - value).abs().minCoeff(&at);
  return CVec(modes->vectors.col(at));
}

std::optional<Critical> critical_of(BifurcationKind kind, const std::vector<Mat>& tangents) {
  const CVec mu = multipliers_of(tangents);
  const auto places = critical_places(kind, mu);
  if (!places) return std::nullopt;
  Mat period = tangents[0];
  for (std::size_t i = 1; i < tangents.size(); ++i) period = tangents[i] * period;
  const auto v = eigenvector(period, mu(places->first));
  const auto w = eigenvector(period.transpose(), mu(places->first));
  if (!v || !w) return std::nullopt;
  const Complex product = w->transpose() * *v;
  if (product == 0.0) return std::nullopt;
  Critical critical{.multiplier = mu(places->first), .right = {*v}, .left = {*w / product}};
  for (std::size_t i = 1; i < tangents.size(); ++i) {
    critical.right.push_back(tangents[i - 1] * critical.right.back());
    critical.left.push_back(tangents[tangents.size() - i].transpose() * critical.left.back());
  }
  std::reverse(critical.left.begin(), critical.left.end());
  return critical;
}

/// Real and imaginary part of a vector, or the former alone where the other is zero.
Mat parts_of(const CVec& v) {
  Mat parts(v.size(), v.imag().isZero(0.0) ? 1 : 2);
  parts.col(0) = v.real();
  if (parts.cols() > 1) parts.col(1) = v.imag();
  return parts;
}

/// The derivatives by motions that carry theirs along; nothing where one of them has none.
std::optional<Slopes> exact_slopes(const BifurcationCurve& curve, const Vec& x, double second,
                                   const Place& here, PlaneParameter by) {
  if (!curve.flows.slopes) return std::nullopt;
  const bool grazes = curve.kind == grazing, by_states = by == PlaneParameter::first;
  std::optional<Critical> critical;
  if (!grazes && !(critical = critical_of(curve.kind, here.orbit.tangents))) return std::nullopt;
  const Vec &scale = curve.scale, to_scale = scale.cwiseInverse();
  const double unit = by_states ? curve.high - curve.low : 1.0;
  const Eigen::Index size = x.size() - 1, n = scale.size();
  Slopes slopes{.by_parameter = Vec::Zero(size + 1), .by_states = Vec::Zero(by_states ? size : 0)};
  for (Eigen::Index first = 0; first < size; first += n) {
    const auto segment = static_cast<std::size_t>(first / n);
    RevolutionAsked asked{.by = by};
    const bool has_graze = grazes && here.graze.start == segment && here.graze.is_found();
    if (has_graze) asked.graze = &here.graze;
    if (critical) asked.deviations = scale.asDiagonal() * parts_of(critical->right[segment]);
    asked.by_start = by_states && (has_graze || critical);
    const auto found =
        curve.flows.slopes(curve.first(x), second, here.orbit.states[segment], asked);
    if (!found) return std::nullopt;
    slopes.by_parameter.segment(first, n) = unit * found->end.cwiseProduct(to_scale);
    double& of_g = slopes.by_parameter(size);
    if (has_graze) {
      of_g = unit * found->depth_by_parameter;
      if (by_states) slopes.by_states.segment(first, n) = found->depth_by_start.cwiseProduct(scale);
    }
    for (Eigen::Index part = 0; part < asked.deviations.cols(); ++part) {
      const Complex one = part == 0 ? Complex(1.0) : Complex(0.0, 1.0);
      const auto change = [&](const auto& end) {
        return critical->change(curve.kind, segment, one * end.cwiseProduct(to_scale));
      };
      of_g += unit * change(found->deviations_by_parameter.col(part));
      if (!by_states) continue;
      const Mat& by_start = found->deviations_by_start[static_cast<std::size_t>(part)];
      for (Eigen::Index k = 0; k < n; ++k) {
        slopes.by_states(first + k) += scale(k) * change(by_start.col(k));
      }
    }
  }
  return slopes;
}

/// dg / dx of a grazing by the states, each difference towards the motion that does not touch.
Vec graze_slopes(const BifurcationCurve& curve, const Vec& x, double second, double g) {
  const double h = curve.difference();
  Vec slopes(x.size() - 1);
  for (Eigen::Index k = 0; k < slopes.size(); ++k) {
    Vec moved = x;
    moved(k) = x(k) + h;
    const double above = curve.graze(moved, second).depth;
    moved(k) = x(k) - h;
    const double below = curve.graze(moved, second).depth;
    slopes(k) = above < below ? (above - g) / h : (g - below) / h;
  }
  return slopes;
}

/// dg / dx of a critical multiplier by the states, each of which moves one segment only; nothing
/// where a moved one has no g.
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

/// The same derivatives by differences of tangents and depths.
std::optional<Slopes> difference_slopes(const BifurcationCurve& curve, const Vec& x, double second,
                                        const Place& here, Failure& failure) {
  const Eigen::Index size = x.size() - 1;
  const double h = curve.difference();
  Vec moved = x;
  moved(size) = x(size) + h;
  const Place beside = place_at(curve, moved, second);
  moved(size) = x(size) - h;
  const Place before = place_at(curve, moved, second);
  if (beside.residual.size() == 0 || before.residual.size() == 0) {
    failure = beside.failure ? beside.failure : before.failure;
    return std::nullopt;
  }
  const std::optional<Vec> by_states = curve.kind == grazing
                                           ? graze_slopes(curve, x, second, here.residual(size))
                                           : multiplier_slopes(curve, x, second, here);
  if (!by_states) {
    failure = "beside it there is no such point";
    return std::nullopt;
  }
  return Slopes{(beside.residual - before.residual) / (2.0 * h), *by_states};
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
  if (x(size) < 0.0 || x(size) > 1.0) return {.failure = "the range of the first parameter ends"};
  const auto here = std::make_shared<const Place>(place_at(curve, x, second));
  BranchEquations::Value at{
      .residual = here->residual, .contacts = here->orbit.contacts, .failure = here->failure};
  if (curve.kind == grazing) {  // whether it touches is rounding here
    for (ContactMeasure& c : at.contacts) c.impacts = 0.0;
  }
  if (wanted == WithTangent::no || at.residual.size() == 0) return at;
  at.jacobian = Mat::Zero(size + 1, size + 1);
  at.jacobian.topLeftCorner(size, size) = shooting_jacobian(here->orbit.tangents);
  std::optional<Slopes> slopes = exact_slopes(curve, x, second, *here, PlaneParameter::first);
  if (!slopes) slopes = difference_slopes(curve, x, second, *here, at.failure);
  if (!slopes) return {.failure = at.failure};
  at.jacobian.col(size) = slopes->by_parameter;
  at.jacobian.row(size).head(size) = slopes->by_states.transpose();
  at.multipliers = [kind = curve.kind, here] {
    return other_multipliers(kind, here->orbit.tangents);
  };
  at.slope = [curve, x, second, here] {
    const auto by_second = exact_slopes(curve, x, second, *here, PlaneParameter::second);
    return by_second ? by_second->by_parameter : Vec();
  };
  return at;
}

/// Takes the extremum of a contact's depth in a step, or on its way into it, if that is nearer to
/// touching than what is known.
///
/// @param rate  of the depth at the end of the step before, or no number; becomes that of this one
void find_graze(const ContactSystem& system, std::size_t contact, const Step& step, double& rate,
                NearestGraze& nearest) {
  const ReducedContact& c = system.contacts()[contact];
  Vec y(system.size());
  const auto at = [&](double s) {
    step.at(s, y.data());
    return kinematics(c, step.instant(s), y.data(), system.layout());
  };
  const auto rate_at = [&](double s) { return at(s).rate; };
  const auto take = [&](double s) {
    const double depth = at(s).depth / c.clearance;
    if (!(std::abs(depth) < std::abs(nearest.depth))) return;
    nearest.depth = depth;
    nearest.time = step.angle(s) / system.phase_rate();
    nearest.contact = static_cast<int>(contact);
  };
  double before = rate_at(0.0);
  // a step that ends at a touch where it grazes: on which side of it is rounding
  if (!std::isnan(rate) && (rate > 0.0) != (before > 0.0)) take(0.0);
  for (int k = 1; k <= scanned; ++k) {
    const double low = double(k - 1) / scanned, high = double(k) / scanned, after = rate_at(high);
    if ((after > 0.0) != (before > 0.0)) {
      take(bracketed_root(rate_at, low, before, high, after, sharpest));
    }
    before = after;
  }
  rate = before;
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

NearestGraze nearest_graze(const Scene& scene, const std::string& contact,
                           std::span<const Vec> starts) {
  const ContactSystem& system = scene.contacts;
  NearestGraze nearest;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    NearestGraze of_start = nearest;
    std::vector<double> rates(system.contacts().size(), std::numeric_limits<double>::quiet_NaN());
    Trajectory t{.system = &system, .revolutions = 1};
    t.state.y = starts[k];
    integrate_single(t, {.tolerance = flow_tolerance}, [&](const Step& step) {
      for (std::size_t i = 0; i < system.contacts().size(); ++i) {
        if (!contact.empty() && system.contacts()[i].name != contact) continue;
        find_graze(system, i, step, rates[i], of_start);
      }
      return true;
    });
    if (std::abs(of_start.depth) < std::abs(nearest.depth)) {
      nearest = of_start;
      nearest.start = k;
    }
  }
  return nearest;
}

}  // namespace whirl::inline dyn
