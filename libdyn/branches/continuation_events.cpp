// What happens between two points of a branch, and where.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/branches/continuation.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double probed = 1e-2;      ///< arc length ahead of an end, for a grazing that causes it
constexpr double zero = 1e-3;        ///< of a test function, where it is located
constexpr double sharper = 1e-3;     ///< than asked for: a steep one must be as small there
constexpr int most_grazings = 8;     ///< between two points
constexpr double recognized = 1e-6;  ///< relative, of the numbers of an orbit that is met again
constexpr double sampled = 1e-3;  ///< likewise, of those taken at points of steps, which may differ
constexpr double halved = 1e-6;   ///< share of the difference of both halves that is none
constexpr double at_vertex = 1e-5;  ///< of the range, where a branch is born

using enum BifurcationKind;

/// By how much the second half of an orbit differs from the first one; empty: it has no halves.
Vec half_difference(const BranchPoint& p, int period) {
  const Eigen::Index size = p.z.size() - 1;
  if (period % 2 != 0 || size % period != 0) return {};
  return p.z.segment(size / 2, size / 2) - p.z.head(size / 2);
}

/// Whether multipliers are the same ones in any order: rounding turns round those of one size.
bool same_multipliers(const CVec& a, const CVec& b) {
  if (a.size() != b.size()) return false;
  std::vector<Complex> left(b.begin(), b.end());
  for (const Complex& value : a) {
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](const Complex& x, const Complex& y) {
          return std::abs(x - value) < std::abs(y - value);
        });
    if (!(std::abs(*nearest - value) <= recognized * b.cwiseAbs().maxCoeff())) return false;
    left.erase(nearest);
  }
  return true;
}

/// Whether two points of the same value are one orbit, wherever on it their states are: an orbit of
/// a free period comes back to itself with another phase.
bool is_same(const BranchPoint& a, const BranchPoint& b) {
  const auto equal = [](double x, double y, double within) {
    return std::abs(x - y) <= within * (std::abs(x) + std::abs(y));
  };
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    if (!equal(a.contacts[c].max_normal, b.contacts[c].max_normal, sampled) ||
        !equal(a.contacts[c].duty, b.contacts[c].duty, recognized) ||
        a.contacts[c].impacts != b.contacts[c].impacts) {
      return false;
    }
  }
  return same_multipliers(a.multipliers, b.multipliers);
}

/// How many impacts a period a contact has more at the second of two orbits; one that touches all
/// the time has none, and begins or ends as one touch.
double change_of(const ContactMeasure& from, const ContactMeasure& to) {
  if (from.impacts != to.impacts) return to.impacts - from.impacts;
  return (to.duty > 0.0 ? 1.0 : 0.0) - (from.duty > 0.0 ? 1.0 : 0.0);
}

bool touch_alike(const std::vector<ContactMeasure>& a, const std::vector<ContactMeasure>& b) {
  for (std::size_t c = 0; c < std::min(a.size(), b.size()); ++c) {
    if (change_of(a[c], b[c]) != 0.0) return false;
  }
  return true;
}

}  // namespace

BranchTrial Continuation::closing(const BranchPoint& a, const BranchPoint& b) const {
  const BranchPoint& first = branch_.points.front();
  const Eigen::Index size = first.z.size() - 1;
  const double from = (a.z(size) - first.z(size)) * first.tangent(size),
               to = (b.z(size) - first.z(size)) * first.tangent(size);
  BranchTrial trial{.failure = "elsewhere"};
  if (branch_.points.size() < 3 || !(from < 0.0 && to >= 0.0)) return trial;
  BranchPlane at{Vec::Unit(size + 1, size), a.z + from / (from - to) * (b.z - a.z)};
  at.at(size) = first.z(size);
  trial = corrector_.correct(at, by_parameter_);
  if (!trial.failure && !is_same(trial.point, first)) trial.failure = "another orbit";
  if (!trial.failure && !corrector_.add_tangent(trial, a.tangent)) trial.failure = "no tangent";
  return trial;
}

BranchTrial Continuation::stop_on_the_way(BranchTrial trial) const {
  const BranchPoint& last = branch_.points.back();
  const double step = trial.point.step;
  if (BranchTrial first = closing(last, trial.point); !first.failure) {
    trial = std::move(first);
    trial.end = {EndKind::closed, "it closes: the first orbit again"};
  }
  if (const auto place = halving(last, trial.point)) {
    if (BranchTrial vertex = between(last, trial.point, *place); !vertex.failure) {
      trial = std::move(vertex);
      trial.end = {EndKind::period_halved, fmt::format("it has half the period from {} on",
                                                       options_.value_text(trial.point.value))};
    }
  }
  trial.point.step = step;
  return trial;
}

void Continuation::forget_vertex(const BranchPoint& vertex) {
  const Eigen::Index size = vertex.z.size() - 1;
  std::erase_if(branch_.bifurcations, [&](const Bifurcation& b) {
    return b.after + 1 == branch_.points.size() && (b.kind == fold || b.kind == pitchfork) &&
           std::abs(b.at.z(size) - vertex.z(size)) < at_vertex;
  });
}

BranchTrial Continuation::beyond_grazing(const Bifurcation& grazes, double u) const {
  constexpr double near = 0.1;  // of the last orbit, in scales
  const BranchPoint& last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const auto duty_of = [&](const BranchPoint& point) {
    const auto found =
        std::find_if(point.contacts.begin(), point.contacts.end(),
                     [&](const ContactMeasure& c) { return c.name == grazes.contact; });
    return found == point.contacts.end() ? nan : found->duty;
  };
  const double before = duty_of(last);
  if (before != 0.0 && before != 1.0) return {.failure = "it touches now and then"};
  const double wanted = 1.0 - before, outward = before == 0.0 ? 1.0 : -1.0;
  const double onward = std::copysign(1.0, last.tangent(size));
  for (const double ahead : {1e-4, 1e-3, 1e-2}) {
    for (const double way : {onward, -onward}) {
      for (const double moved : {1e-4, 1e-3, 1e-2}) {
        Vec z = (1.0 + outward * moved) * last.z;
        z(size) = u + way * ahead;
        if (z(size) < 0.0 || z(size) > 1.0) continue;
        BranchTrial trial = corrector_.correct({Vec::Unit(size + 1, size), z}, Vec());
        if (trial.failure || duty_of(trial.point) != wanted) continue;
        const Vec step = trial.point.z - last.z;
        if (corrector_.dot(step, step) > near * near || !corrector_.add_tangent(trial, step))
          continue;
        trial.point.step = limited(ahead, trial.point.tangent);
        return trial;
      }
    }
  }
  return {.failure = "no orbit is near"};
}

void Continuation::cross_or_end(const std::string& why) {
  const BranchPoint& last = branch_.points.back();
  branch_.end = {
      EndKind::no_orbit,
      fmt::format("no orbit is found beyond {}: {}", options_.value_text(last.value), why), why};
  // the motions that the tangent predicts: do they touch otherwise, and from where on
  const auto touches_differ = [&](double length, std::vector<ContactMeasure>& seen) {
    Vec z = last.z + length * last.tangent;
    z(z.size() - 1) = std::clamp(z(z.size() - 1), 0.0, 1.0);
    BranchEquations::Value at = corrector_.evaluate(z, WithTangent::no);
    if (at.residual.size() == 0) return false;
    seen = std::move(at.contacts);
    return !touch_alike(seen, last.contacts);
  };
  std::vector<ContactMeasure> seen;
  double low = 0.0, high = options_.smallest_step;
  while (high < probed && !touches_differ(high, seen)) {
    low = high;
    high *= 2.0;
  }
  if (high >= probed) return;
  for (std::vector<ContactMeasure> middle; high - low > 1e-3 * high;) {
    const double half = 0.5 * (low + high);
    if (touches_differ(half, middle)) {
      high = half;
      seen = middle;
    } else {
      low = half;
    }
  }
  for (std::size_t c = 0; c < seen.size(); ++c) {
    const double change = change_of(last.contacts[c], seen[c]);
    if (change == 0.0) continue;
    Bifurcation end{.kind = grazing,
                    .at = last,
                    .after = branch_.points.size() - 1,
                    .contact = last.contacts[c].name,
                    .change = change,
                    .multiplier = critical_multiplier(grazing, {})};
    const double u =
        std::clamp(last.z(last.z.size() - 1) + high * last.tangent(last.z.size() - 1), 0.0, 1.0);
    end.at.value = corrector_.value_of(u);
    if (BranchTrial beyond = beyond_grazing(end, u); !beyond.failure) {
      end.change = change_of(last.contacts[c], beyond.point.contacts[c]);
      branch_.bifurcations.push_back(std::move(end));
      branch_.end.reset();
      accept(std::move(beyond));
      return;
    }
    branch_.end = {EndKind::grazing,
                   fmt::format("contact {} grazes at about {:.7g}, beyond {} no orbit is found",
                               end.contact, end.at.value, options_.value_text(last.value))};
    branch_.bifurcations.push_back(std::move(end));
  }
}

BranchTrial Continuation::between(const BranchPoint& a, const BranchPoint& b, double length) const {
  const Vec chord = b.z - a.z;
  BranchPlane plane{chord / std::sqrt(corrector_.dot(chord, chord)), a.z};
  plane.at += length * plane.normal;
  BranchTrial trial = corrector_.correct(plane, by_parameter_);
  // where two branches meet there is no single tangent
  if (!trial.failure && !corrector_.add_tangent(trial, plane.normal)) {
    trial.point.tangent = plane.normal;
  }
  return trial;
}

std::optional<double> Continuation::halving(const BranchPoint& a, const BranchPoint& b) const {
  const Vec before = half_difference(a, branch_.period), after = half_difference(b, branch_.period);
  if (before.size() == 0 || a.multipliers.size() == 0) return std::nullopt;
  const double from = before.squaredNorm(), to = before.dot(after);
  if (to > halved * from) return std::nullopt;
  const Vec chord = b.z - a.z;
  return std::sqrt(corrector_.dot(chord, chord)) * std::clamp(from / (from - to), 0.0, 1.0);
}

bool Continuation::find_bifurcations(const BranchPoint& a, const BranchPoint& b) {
  const std::size_t known = branch_.bifurcations.size();
  const auto changes = [&](BifurcationKind kind) {
    return (test_function(kind, a) > 0.0) != (test_function(kind, b) > 0.0);
  };
  const bool folds = changes(fold);
  bool all = true;
  if (folds) all = locate(fold, a, b);
  if (changes(period_doubling)) all = locate(period_doubling, a, b) && all;
  if (changes(pitchfork) != folds) all = locate(pitchfork, a, b) && all;
  if (changes(neimark_sacker)) all = locate(neimark_sacker, a, b) && all;
  if (!touch_alike(a.contacts, b.contacts)) all = locate_grazings(a, b) && all;
  const Vec chord = b.z - a.z;
  std::stable_sort(branch_.bifurcations.begin() + static_cast<std::ptrdiff_t>(known),
                   branch_.bifurcations.end(), [&](const Bifurcation& x, const Bifurcation& y) {
                     return corrector_.dot(chord, x.at.z - y.at.z) < 0.0;
                   });
  return all;
}

bool Continuation::locate(BifurcationKind kind, const BranchPoint& a, const BranchPoint& b) {
  const Vec chord = b.z - a.z;
  const double f_a = test_function(kind, a), f_b = test_function(kind, b);
  BranchPoint best = std::abs(f_a) < std::abs(f_b) ? a : b;
  double least = std::min(std::abs(f_a), std::abs(f_b));
  const auto f = [&](double length) {
    BranchTrial trial = between(a, b, length);
    if (trial.failure) return nan;
    const double value = test_function(kind, trial.point);
    if (std::abs(value) < least) {
      least = std::abs(value);
      best = std::move(trial.point);
    }
    return value;
  };
  bracketed_root(f, 0.0, f_a, std::sqrt(corrector_.dot(chord, chord)), f_b,
                 sharper * options_.located);
  if (!(least < zero)) return false;
  const Complex mu = critical_multiplier(kind, best.multipliers);
  if (kind == neimark_sacker && std::abs(mu.imag()) < 1e-8)
    return true;  // a real pair, 1/mu and mu
  branch_.bifurcations.push_back(
      {.kind = kind, .at = std::move(best), .after = branch_.points.size() - 1, .multiplier = mu});
  return true;
}

bool Continuation::locate_grazings(const BranchPoint& a, const BranchPoint& b) {
  const Vec chord = b.z - a.z;
  const double whole = std::sqrt(corrector_.dot(chord, chord));
  double from = 0.0;
  BranchPoint before = a;
  for (int k = 0; k < most_grazings && !touch_alike(before.contacts, b.contacts); ++k) {
    double low = from, high = whole;
    BranchPoint beyond = b;
    while (high - low > 1e-12 && std::abs(beyond.z(beyond.z.size() - 1) -
                                          before.z(before.z.size() - 1)) > options_.located) {
      const double middle = 0.5 * (low + high);
      BranchTrial trial = between(a, b, middle);
      if (trial.failure) return false;
      if (touch_alike(trial.point.contacts, before.contacts)) {
        low = middle;
        before = std::move(trial.point);
      } else {
        high = middle;
        beyond = std::move(trial.point);
      }
    }
    for (std::size_t c = 0; c < beyond.contacts.size(); ++c) {
      const double change = change_of(before.contacts[c], beyond.contacts[c]);
      if (change == 0.0) continue;
      branch_.bifurcations.push_back({.kind = grazing,
                                      .at = beyond,
                                      .after = branch_.points.size() - 1,
                                      .contact = beyond.contacts[c].name,
                                      .change = change,
                                      .multiplier = critical_multiplier(grazing, {})});
    }
    before = std::move(beyond);
    from = high;
  }
  return touch_alike(before.contacts, b.contacts);
}

}  // namespace whirl::inline dyn
