// Branches of periodic orbits: maps whose bifurcations are known exactly, Duffing's folds, an
// impact oscillator in closed form, and the rotor in its stator.

#include "libdyn/branches/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/impact_oscillator.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::continuation_test {

using enum BifurcationKind;

constexpr double located = 1e-6;  ///< relative, to which bifurcations are to be found

/// How near to the grazing of a rigid impact a branch gets: the steps that converge there go with
/// the square of the speed of the impact, and the speed with the distance.
constexpr double near_grazing = 5e-3;

/// x -> x^2 + c
Flow quadratic(double c) {
  return test::map_flow(1, [c](const Vec& y, Vec& f, Mat& J) {
    f(0) = y(0) * y(0) + c;
    J(0, 0) = 2.0 * y(0);
  });
}

std::vector<double> values(const Branch& branch, BifurcationKind kind) {
  std::vector<double> found;
  for (const Bifurcation& b : branch.bifurcations) {
    if (b.kind == kind) found.push_back(b.at.value);
  }
  return found;
}

Branch walk_to_the_end(Continuation walk) {
  while (walk.advance()) {
  }
  return walk.branch();
}

/// The branch that begins at a bifurcation, until it ends.
Branch switched(const FlowAt& flow_at, const Vec& scale, int period, const Bifurcation& at,
                const ContinuationOptions& options) {
  const auto next = switch_branch(flow_at, scale, period, at);
  EXPECT_TRUE(next);
  if (!next) return {};
  return walk_to_the_end({shooting_equations(flow_at, scale),
                          Branch{.period = next->period, .points = {next->start}}, options});
}

// An orbit that doubles its period goes round twice: impacts double, shares of the time stay.
TEST(SwitchBranch, OfADoubledPeriodHasTwiceTheImpacts) {
  const ContinuationOptions options{.low = -1.0, .high = 0.0, .first = -1.0, .largest_step = 0.05};
  const Vec start = Vec::Constant(1, 0.5 - std::sqrt(1.25));  // x = x^2 + c at c = -1
  const Branch branch = walk_to_the_end(orbit_continuation(quadratic, start, options));
  ASSERT_EQ(branch.bifurcations.size(), 1u);
  Bifurcation at = branch.bifurcations[0];
  ASSERT_EQ(at.kind, period_doubling);
  at.at.contacts = {{.name = "ring", .duty = 0.25, .impacts = 3.0}};
  const auto next = switch_branch(quadratic, Vec::Ones(1), 1, at);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->period, 2);
  ASSERT_EQ(next->start.contacts.size(), 1u);
  EXPECT_EQ(next->start.contacts[0].impacts, 6.0);
  EXPECT_EQ(next->start.contacts[0].duty, 0.25);
}

// x^2 + u^2 = 1 is a closed branch. That it closes is seen although its multipliers, a complex
// pair, come in any order, and the largest force, which is taken at points of steps, a little
// different each time: orbits of a free period come back to themselves with another phase.
TEST(Continuation, ClosesWhateverTheOrderOfMultipliers) {
  int calls = 0;
  const BranchEquations circle{[&](const Vec& x, double u, WithTangent) {
    const bool is_odd = ++calls % 2 != 0;
    const Complex mu(0.3, is_odd ? 0.4 : -0.4);
    BranchEquations::Value at{.residual = Vec::Constant(1, x(0) * x(0) + u * u - 1.0),
                              .jacobian = Mat::Constant(1, 1, 2.0 * x(0))};
    at.multipliers = [mu] { return CVec{{mu, std::conj(mu)}}; };
    at.contacts = {{.name = "ring",
                    .duty = 0.5,
                    .impacts = 1.0,
                    .max_normal = 100.0 * (is_odd ? 1.0 : 1.0 + 1e-5)}};
    return at;
  }};
  for (const double first : {0.3, 0.31, 0.32, 0.33}) {  // closed or not by chance, once
    const ContinuationOptions options{
        .low = -2.0, .high = 2.0, .first = first, .largest_step = 0.04, .most_points = 1000};
    const Branch branch =
        walk_to_the_end({circle, Vec::Constant(1, std::sqrt(1.0 - first * first)), options});
    EXPECT_TRUE(branch.ends_as(EndKind::closed)) << first << ": " << branch.end_text();
  }
}

// x -> x^2 + c: fixed points 1/2 +- sqrt(1/4 - c) meet at c = 1/4; the lower one doubles its period
// at -3/4, that of period 2 at -5/4; period 3 comes up in a fold at -7/4.
TEST(Continuation, FindsFoldsAndPeriodDoublingsOfTheQuadraticMap) {
  const ContinuationOptions options{.low = -1.5, .high = 0.5, .first = -1.5, .largest_step = 0.05};
  const double x = 0.5 - std::sqrt(1.75);
  const Branch branch =
      walk_to_the_end(orbit_continuation(quadratic, Vec(Vec::Constant(1, x + 0.01)), options));
  EXPECT_TRUE(branch.ends_as(EndKind::range)) << branch.end_text();
  EXPECT_EQ(branch.points.front().value, -1.5);
  EXPECT_EQ(branch.points.back().value, -1.5);  // round the fold and back
  EXPECT_NEAR(branch.points.back().z(0), 0.5 + std::sqrt(1.75), 1e-11);
  ASSERT_EQ(branch.bifurcations.size(), 2u);
  EXPECT_EQ(branch.bifurcations[0].kind, period_doubling);
  EXPECT_NEAR(branch.bifurcations[0].at.value, -0.75, located);
  EXPECT_NEAR(std::abs(branch.bifurcations[0].multiplier + 1.0), 0.0, located);
  EXPECT_EQ(branch.bifurcations[1].kind, fold);
  EXPECT_NEAR(branch.bifurcations[1].at.value, 0.25, located);
  for (const BranchPoint& p : branch.points) {
    EXPECT_NEAR(p.multipliers(0).real(), 2.0 * p.z(0), 1e-12);
    EXPECT_EQ(p.is_stable(), std::abs(p.z(0)) < 0.5);
  }

  const Branch two = switched(quadratic, Vec::Ones(1), 1, branch.bifurcations[0], options);
  EXPECT_EQ(two.period, 2);
  EXPECT_TRUE(two.ends_as(EndKind::range)) << two.end_text();
  ASSERT_EQ(values(two, period_doubling).size(), 1u);
  EXPECT_NEAR(values(two, period_doubling)[0], -1.25, located);

  const ContinuationOptions three{
      .low = -1.9, .high = -1.7, .first = -1.9, .largest_step = 0.01, .period = 3};
  const Branch window =
      walk_to_the_end(orbit_continuation(quadratic, Vec(Vec::Constant(1, -1.9)), three));
  ASSERT_EQ(values(window, fold).size(), 1u);
  EXPECT_NEAR(values(window, fold)[0], -1.75, located);
}

// x -> r x (1 - x) with r = 3.2 - p^2: period 2 lives where r > 3, and the branch that begins at
// p = -sqrt(0.2) ends at sqrt(0.2), where it has period 1 again. It has no other bifurcation.
TEST(Continuation, EndsWhereThePeriodIsHalved) {
  const FlowAt logistic = [](double p) {
    return test::map_flow(1, [r = 3.2 - p * p](const Vec& y, Vec& f, Mat& J) {
      f(0) = r * y(0) * (1.0 - y(0));
      J(0, 0) = r * (1.0 - 2.0 * y(0));
    });
  };
  const ContinuationOptions options{.low = -0.7, .high = 0.7, .first = -0.7};
  const Branch one =
      walk_to_the_end(orbit_continuation(logistic, Vec(Vec::Constant(1, 0.63)), options));
  ASSERT_EQ(values(one, period_doubling).size(), 2u);
  const Branch two = switched(logistic, Vec::Ones(1), 1, one.bifurcations[0], options);
  ASSERT_TRUE(two.ends_as(EndKind::period_halved)) << two.end_text();
  EXPECT_NEAR(std::abs(two.points.back().value), std::sqrt(0.2), 1e-5);
  EXPECT_NEAR(two.points.back().value, -two.points.front().value, 1e-5);
  EXPECT_TRUE(two.bifurcations.empty());
}

// x -> (1 + c) x - x^3: the pitchfork at c = 0 bears x = +-sqrt(c).
TEST(Continuation, SwitchesAtAPitchfork) {
  const FlowAt cubic = [](double c) {
    return test::map_flow(1, [c](const Vec& y, Vec& f, Mat& J) {
      f(0) = (1.0 + c) * y(0) - y(0) * y(0) * y(0);
      J(0, 0) = 1.0 + c - 3.0 * y(0) * y(0);
    });
  };
  const ContinuationOptions options{.low = -0.5, .high = 0.5, .first = -0.5};
  const Branch branch = walk_to_the_end(orbit_continuation(cubic, Vec(Vec::Zero(1)), options));
  ASSERT_EQ(branch.bifurcations.size(), 1u);
  EXPECT_EQ(branch.bifurcations[0].kind, pitchfork);
  EXPECT_NEAR(branch.bifurcations[0].at.value, 0.0, located);
  const Branch side = switched(cubic, Vec::Ones(1), 1, branch.bifurcations[0], options);
  EXPECT_EQ(side.points.back().value, 0.5);
  EXPECT_NEAR(std::abs(side.points.back().z(0)), std::sqrt(0.5), 1e-11);
  EXPECT_TRUE(side.points.back().is_stable());
}

// The delayed logistic map (x, y) -> (a x (1 - y), x): x = y = 1 - 1 / a loses its stability at a =
// 2 with the multipliers exp(+-i pi / 3).
TEST(Continuation, FindsANeimarkSackerBifurcation) {
  const FlowAt logistic = [](double a) {
    return test::map_flow(2, [a](const Vec& y, Vec& f, Mat& J) {
      f << a * y(0) * (1.0 - y(1)), y(0);
      J << a * (1.0 - y(1)), -a * y(0), 1.0, 0.0;
    });
  };
  const Branch branch = walk_to_the_end(orbit_continuation(
      logistic, Vec(Vec::Constant(2, 1.0 / 3.0)), {.low = 1.5, .high = 2.5, .first = 1.5}));
  ASSERT_EQ(branch.bifurcations.size(), 1u);
  EXPECT_EQ(branch.bifurcations[0].kind, neimark_sacker);
  EXPECT_NEAR(branch.bifurcations[0].at.value, 2.0, located);
  EXPECT_NEAR(std::abs(branch.bifurcations[0].multiplier - std::polar(1.0, std::numbers::pi / 3.0)),
              0.0, 1e-5);
}

// Duffing's equation with damping e / 2, stiffness 1 + e x^2, force 2 e: one harmonic is the first
// order of averaging, so that the frequencies of both folds come out of it to the order e^2.
TEST(Continuation, FindsTheFoldsOfDuffingsEquation) {
  std::vector<double> number, errors[2];
  for (const double e : {0.01, 0.005, 0.0025}) {
    const auto at = [e](double w) {
      return test::Duffing{.zeta = 0.1 * e, .b = e, .F = 0.5 * e, .w = w};
    };
    const auto flow_at = [&](double w) {
      return test::flow_of(at(w).equation(), 2, 2.0 * std::numbers::pi / w, 10);
    };
    const Branch branch = walk_to_the_end(orbit_continuation(
        flow_at, Vec(Vec::Zero(2)),
        {.low = 1.0 - e, .high = 1.0 + 4.0 * e, .first = 1.0 - e, .largest_step = 0.2 * e}));
    EXPECT_EQ(branch.points.back().value, 1.0 + 4.0 * e);
    const std::vector<double> folds = values(branch, fold);
    ASSERT_EQ(folds.size(), 2u) << e;
    const auto [upper, lower] = test::harmonic_folds(0.1 * e, e, 0.5 * e);
    number.push_back(1.0 / e);
    errors[0].push_back(std::abs(folds[0] - upper));
    errors[1].push_back(std::abs(folds[1] - lower));
    EXPECT_EQ(branch.bifurcations.size(), 2u);
  }
  EXPECT_NEAR(test::order_of(number, errors[0]), 2.0, 0.2) << testing::PrintToString(errors[0]);
  EXPECT_NEAR(test::order_of(number, errors[1]), 2.0, 0.2) << testing::PrintToString(errors[1]);
}

// An oscillator against a rigid wall: its orbit with one impact a period, multipliers, fold and end
// in a grazing at A = d are known in closed form. Impacts make the tangent grow like 1 / v there.
TEST(Continuation, FollowsAnImpactingOrbitRoundItsFoldToItsGrazing) {
  const test::ImpactOscillator p{.w = 1.6};
  const auto flow_at = [&](double A) {
    test::ImpactOscillator at = p;
    at.A = A;
    return at.flow();
  };
  const double v_fold = -p.d * p.k() / (p.k() * p.k() + p.g() * p.g());
  EXPECT_NEAR(p.trace(v_fold), 1.0 + p.r * p.r, 1e-12);  // two ways to the fold
  // from the orbit at v = 4: just after its impact, moved on to phase 0
  const double v = 4.0, A = p.amplitude(v);
  Continuation walk = orbit_continuation(
      flow_at,
      [&] {
        const double c = (p.d + v * p.k()) / A,
                     s = -v * p.g() / A;  // of w t - 4 at the impact
        const double t = (std::atan2(s, c) + 4.0) / p.w;
        test::ImpactOscillator moving = p;
        moving.A = A;
        return moving.moved(Vec{{p.d, -p.r * v}}, t, p.period());
      }(),
      {.low = 0.05,
       .high = 1.6,
       .first = A,
       .direction = -1.0,
       .largest_step = 0.05,
       .smallest_step = 1e-5});
  while (walk.advance()) {
  }
  const Branch& branch = walk.branch();
  const std::vector<double> folds = values(branch, fold), grazings = values(branch, grazing);
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_NEAR(folds[0] / p.amplitude(v_fold), 1.0, located);
  ASSERT_EQ(grazings.size(), 1u) << branch.end_text();
  EXPECT_NEAR(grazings[0], p.d, near_grazing);
  EXPECT_EQ(branch.bifurcations.back().contact, "wall");
  EXPECT_EQ(branch.bifurcations.back().change, -1.0);
  EXPECT_TRUE(branch.ends_as(EndKind::grazing)) << branch.end_text();
  // multipliers on both sides of the fold: v solves (k^2 + g^2) v^2 + 2 d k v + d^2 - A^2 = 0
  const double a = p.k() * p.k() + p.g() * p.g(), b = p.d * p.k();
  std::size_t number = 0;
  for (const BranchPoint& point : branch.points) {
    const double root = std::sqrt(b * b - a * (p.d * p.d - point.value * point.value));
    const double speed = (-b + (number++ <= branch.bifurcations[0].after ? root : -root)) / a;
    if (speed < 1e-2) continue;
    const Complex sum = point.multipliers.sum(), product = point.multipliers.prod();
    EXPECT_NEAR(std::abs(sum - p.trace(speed)), 0.0,
                1e-7 * std::abs(p.trace(speed)) / std::min(1.0, root));
    EXPECT_NEAR(std::abs(product - p.r * p.r), 0.0, 1e-9 / speed);
  }
}

// The same wall at another frequency: the orbit doubles its period at the speed v where its
// multipliers are -1 and -r^2.
TEST(Continuation, FindsThePeriodDoublingOfAnImpactingOrbit) {
  const test::ImpactOscillator p{.w = 2.2};
  const auto flow_at = [&](double A) {
    test::ImpactOscillator at = p;
    at.A = A;
    return at.flow();
  };
  const double v_double = p.speed(-1.0 - p.r * p.r), v = 2.0 * v_double, A = p.amplitude(v);
  test::ImpactOscillator moving = p;
  moving.A = A;
  const double c = (p.d + v * p.k()) / A, s = -v * p.g() / A;
  const double t = (std::atan2(s, c) + 4.0) / p.w;
  Continuation walk = orbit_continuation(
      flow_at, moving.moved(Vec{{p.d, -p.r * v}}, t, p.period()),
      {.low = 0.5, .high = A, .first = A, .direction = -1.0, .smallest_step = 1e-5});
  while (walk.advance()) {
  }
  const std::vector<double> doublings = values(walk.branch(), period_doubling);
  ASSERT_GE(doublings.size(), 1u);
  EXPECT_NEAR(doublings[0] / p.amplitude(v_double), 1.0, located);
  // and gets as near to its grazing at A = d as orbits can be computed
  EXPECT_NEAR(walk.branch().points.back().value, p.d, near_grazing);
}

/// The rotor in its stator at 138.4 rad/s and 64 MN/m, over friction.
struct Cascade {
  static test::RotorStator at(double mu) { return {.Omega = 138.4, .kC = 64e6, .mu = mu}; }
  std::shared_ptr<const Scene> first = std::make_shared<const Scene>(at(0.15).scene());
  FlowAt flow_at = [this](double mu) {
    return flow_of(std::make_shared<const Scene>(at(mu).scene()), *first);
  };
  ContinuationOptions options{
      .low = 0.0, .high = 0.15, .first = 0.15, .direction = -1.0, .largest_step = 0.002};

  Vec start() const {
    Trajectory t{.system = &first->contacts,
                 .state = test::start_of(at(0.15).model(), *first),
                 .revolutions = 300};
    integrate_single(t, {});
    return t.state.y;
  }
};

// Period 1 at 0.15, 2 at 0.12, 4 at 0.11, 8 at 0.107, as simulations say: each doubling lies
// between. The orbit of period 1 goes on, unstable, through chaos to no friction at all.
TEST(Continuation, FollowsACascadeIntoChaos) {
  const Cascade rotor;
  const Branch one =
      walk_to_the_end(orbit_continuation(rotor.flow_at, rotor.start(), rotor.options));
  EXPECT_EQ(one.points.back().value, 0.0);
  EXPECT_FALSE(one.points.back().is_stable());
  ASSERT_EQ(one.bifurcations.size(), 1u);
  EXPECT_EQ(one.bifurcations[0].kind, period_doubling);
  EXPECT_GT(one.bifurcations[0].at.value, 0.12);

  const Vec scale = rotor.first->contacts.state_scale();
  const Branch two = switched(rotor.flow_at, scale, 1, one.bifurcations[0], rotor.options);
  ASSERT_GE(values(two, period_doubling).size(), 1u);
  const Branch four = switched(rotor.flow_at, scale, 2, two.bifurcations[0], rotor.options);
  ASSERT_GE(values(four, period_doubling).size(), 1u);
  const double d1 = one.bifurcations[0].at.value, d2 = values(two, period_doubling)[0],
               d3 = values(four, period_doubling)[0];
  EXPECT_TRUE(0.11 < d2 && d2 < 0.12) << d2;
  EXPECT_TRUE(0.107 < d3 && d3 < 0.11) << d3;
  // Feigenbaum's ratio, 4.669 in the limit, is not there yet, nor far
  EXPECT_GT((d1 - d2) / (d2 - d3), 1.0);
  EXPECT_LT((d1 - d2) / (d2 - d3), 4.67);

  // simulations from beside the orbits come back where these are stable, and leave where they are
  // not
  constexpr double beside = 1e-6, clear = 0.02;  // clearances; of the largest multiplier from 1
  int stable = 0, unstable = 0;
  for (const Branch* branch : {&one, &two, &four}) {
    for (std::size_t i = 1; i < branch->points.size(); i += 4) {
      const BranchPoint& point = branch->points[i];
      const double largest = std::abs(point.multipliers(0));
      if (std::abs(largest - 1.0) < clear) continue;
      (point.is_stable() ? stable : unstable) += 1;
      const Scene scene = Cascade::at(point.value).scene();
      const Vec orbit = point.state(scale);
      Trajectory t{.system = &scene.contacts,
                   .state = test::state_of(orbit + beside * scale),
                   .revolutions = 250L * branch->period};
      integrate_single(t, {.tolerance = 1e-12});
      const double away = distance(scene.contacts, t.state.y, orbit);
      if (point.is_stable()) {
        EXPECT_LT(away, 0.1 * beside) << point.value;
      } else {
        EXPECT_GT(away, 100.0 * beside) << point.value;
      }
    }
  }
  EXPECT_GT(stable, 5);
  EXPECT_GT(unstable, 5);
}

// A branch that is taken up again from its points goes on with the same numbers, bit by bit.
TEST(Continuation, GoesOnBitByBit) {
  const Cascade rotor;
  Continuation whole = orbit_continuation(rotor.flow_at, rotor.start(), rotor.options);
  while (whole.advance() && whole.branch().points.size() < 30) {
  }
  Branch part = whole.branch();
  part.points.resize(8);
  part.bifurcations.clear();
  Continuation rest(shooting_equations(rotor.flow_at, rotor.first->contacts.state_scale()), part,
                    rotor.options);
  while (rest.branch().points.size() < 30 && rest.advance()) {
  }
  ASSERT_EQ(rest.branch().points.size(), 30u);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), sizeof(a(0)) * static_cast<std::size_t>(a.size())) == 0;
  };
  for (std::size_t i = 0; i < 30; ++i) {
    const BranchPoint &a = whole.branch().points[i], &b = rest.branch().points[i];
    EXPECT_TRUE(same(a.z, b.z) && same(a.tangent, b.tangent) && same(a.multipliers, b.multipliers));
    EXPECT_EQ(a.step, b.step);
  }
  ASSERT_EQ(rest.branch().bifurcations.size(), whole.branch().bifurcations.size());
  EXPECT_EQ(rest.branch().bifurcations[0].at.value, whole.branch().bifurcations[0].at.value);
}

TEST(Continuation, RefusesWrongOptions) {
  EXPECT_THROW(orbit_continuation(quadratic, Vec(Vec::Zero(1)), {.low = 1.0, .high = 0.0}),
               OptionError);
  EXPECT_THROW(orbit_continuation(quadratic, Vec(Vec::Zero(1)), {.first = 2.0}), OptionError);
  EXPECT_THROW(orbit_continuation(quadratic, Vec(Vec::Zero(1)), {.direction = 0.5}), OptionError);
  // x^2 + 1 has no real fixed point
  EXPECT_THROW(orbit_continuation(quadratic, Vec(Vec::Zero(1)), {.first = 1.0}), NumericalError);
}

}  // namespace whirl::continuation_test
