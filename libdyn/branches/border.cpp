#include "libdyn/branches/border.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/floquet.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl {

namespace {

constexpr double aside = 2e-7;   ///< of the scales, for differences of test functions
constexpr double hardly = 1e-8;  ///< likewise beside a grazing, where they are smooth on one side
constexpr double none = 1e3;     ///< of a graze where there is no extremum
constexpr int scanned = 8;       ///< parts of a step in which an extremum is looked for

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

}  // namespace

BranchEquations border_equations(BifurcationKind kind, FlowPlane flows, Vec scale, double low,
                                 double high) {
  if (kind == pitchfork) {
    throw NumericalError("a pitchfork lives by a symmetry and has no border in a plane");
  }
  const double h = kind == grazing ? hardly : aside;
  const auto states_of = [scale](const Vec& x) {
    std::vector<Vec> states;
    for (Eigen::Index i = 0; i + scale.size() <= x.size(); i += scale.size()) {
      states.emplace_back(scale.cwiseProduct(x.segment(i, scale.size())));
    }
    return states;
  };
  /// Gaps and g at a place; empty where one of them fails.
  struct Place {
    PeriodicOrbit orbit;
    Vec residual;
    std::string failure;
  };
  const auto place = [=](const Vec& x, double first, double second) {
    Place p;
    p.orbit.states = states_of(x);
    p.orbit.period = static_cast<int>(p.orbit.states.size());
    Flow flow = flows.at(first, second);
    flow.scale = scale;
    const Vec gaps = shoot(flow, p.orbit);
    p.failure = p.orbit.failure;
    if (gaps.size() == 0) return p;
    const std::optional<double> g = kind == grazing
                                        ? flows.graze(first, second, p.orbit.states)
                                        : test_value(kind, multipliers_of(p.orbit.tangents));
    if (!g) {
      p.failure = kind == neimark_sacker ? "the critical pair becomes real: a strong resonance"
                                         : "the critical multiplier meets another one";
      return p;
    }
    p.residual.resize(gaps.size() + 1);
    p.residual << gaps, *g;
    return p;
  };
  return {[=](const Vec& x, double second, Tangents wanted) {
            const Eigen::Index size = x.size() - 1, n = scale.size();
            const auto first = [&](double u) { return low + u * (high - low); };
            if (x(size) < 0.0 || x(size) > 1.0) {
              return BranchEquations::Value{.failure = "the range of the first parameter ends"};
            }
            Place here = place(x.head(size), first(x(size)), second);
            BranchEquations::Value at{.residual = here.residual,
                                      .contacts = here.orbit.contacts,
                                      .failure = here.failure};
            if (kind == grazing) {  // whether it touches is rounding here
              for (ContactMeasure& c : at.contacts) c.impacts = 0.0;
            }
            if (wanted == Tangents::no || at.residual.size() == 0) return at;
            at.jacobian = Mat::Zero(size + 1, size + 1);
            at.jacobian.topLeftCorner(size, size) = shooting_jacobian(here.orbit.tangents);
            const Place beside = place(x.head(size), first(x(size) + h), second);
            const Place before = place(x.head(size), first(x(size) - h), second);
            if (beside.residual.size() == 0 || before.residual.size() == 0) {
              return BranchEquations::Value{.failure = beside.failure + before.failure};
            }
            at.jacobian.col(size) = (beside.residual - before.residual) / (2.0 * h);
            // g by the states: each moves one segment only
            const double g = at.residual(size);
            if (kind == grazing) {
              for (Eigen::Index k = 0; k < size; ++k) {
                Vec moved = x.head(size);
                moved(k) += h;
                const double above = flows.graze(first(x(size)), second, states_of(moved));
                moved(k) = x(k) - h;
                const double below = flows.graze(first(x(size)), second, states_of(moved));
                // towards the motion that does not touch
                at.jacobian(size, k) = above < below ? (above - g) / h : (g - below) / h;
              }
            } else {
              std::vector<Vec> starts;
              for (Eigen::Index k = 0; k < size; ++k) {
                starts.push_back(here.orbit.states[static_cast<std::size_t>(k / n)]);
                starts.back()(k % n) += h * scale(k % n);
              }
              const auto passages = flows.at(first(x(size)), second).go(starts, 1, Tangents::yes);
              for (Eigen::Index k = 0; k < size; ++k) {
                const Passage& p = passages[static_cast<std::size_t>(k)];
                std::vector<Mat> tangents = here.orbit.tangents;
                if (p.failure.empty()) {
                  tangents[static_cast<std::size_t>(k / n)] =
                      scale.cwiseInverse().asDiagonal() * p.tangent * scale.asDiagonal();
                }
                const auto moved = test_value(kind, multipliers_of(tangents));
                if (!p.failure.empty() || !moved) {
                  return BranchEquations::Value{.failure = "beside it there is no such point"};
                }
                at.jacobian(size, k) = (*moved - g) / h;
              }
            }
            at.multipliers = [kind, tangents = std::move(here.orbit.tangents)]() -> CVec {
              const CVec all = multipliers_of(tangents);
              if (kind == grazing) return all;
              const auto critical = critical_places(kind, all);
              std::vector<Complex> others;
              for (Eigen::Index i = 0; i < all.size(); ++i) {
                if (!critical || (i != critical->first && i != critical->second)) {
                  others.push_back(all(i));
                }
              }
              return Eigen::Map<const CVec>(others.data(), std::ssize(others));
            };
            return at;
          },
          h};
}

double nearest_graze(const Scene& scene, const std::string& contact, std::span<const Vec> starts) {
  const ContactSystem& system = scene.contacts;
  double nearest = none;
  Vec y(system.size());
  for (const Vec& start : starts) {
    Trajectory t{.system = &system, .revolutions = 1};
    t.state.y = start;
    integrate_single(t, {.tolerance = flow_tolerance}, [&](const Step& step) {
      for (const ReducedContact& c : system.contacts()) {
        if (!contact.empty() && c.name != contact) continue;
        const auto at = [&](double s) {
          step.at(s, y.data());
          return kinematics(c, step.phase + s * step.turn, y.data(), system.coordinates());
        };
        double before = at(0.0).rate;
        for (int k = 1; k <= scanned; ++k) {
          const double rate = at(double(k) / scanned).rate;
          if ((rate > 0.0) != (before > 0.0)) {
            double low = double(k - 1) / scanned, high = double(k) / scanned;
            for (int i = 0; i < 50; ++i) {
              const double middle = 0.5 * (low + high);
              ((at(middle).rate > 0.0) == (before > 0.0) ? low : high) = middle;
            }
            const double depth = at(0.5 * (low + high)).depth / c.clearance;
            if (std::abs(depth) < std::abs(nearest)) nearest = depth;
          }
          before = rate;
        }
      }
      return true;
    });
  }
  return nearest;
}

}  // namespace whirl
