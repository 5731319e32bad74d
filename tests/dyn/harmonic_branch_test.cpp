// Branches by harmonic balance: folds of one harmonic in closed form, of many against shooting, and
// a period doubling of the rotor in its stator.

#include "libdyn/branches/harmonic_branch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/branches/continuation.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::harmonic_branch_test {

using enum BifurcationKind;

Branch walk_to_the_end(Continuation walk) {
  while (walk.advance()) {
  }
  return walk.branch();
}

std::vector<double> values(const Branch& branch, BifurcationKind kind) {
  std::vector<double> found;
  for (const Bifurcation& b : branch.bifurcations) {
    if (b.kind == kind) found.push_back(b.at.value);
  }
  return found;
}

/// Duffing's equation at a frequency.
std::shared_ptr<const HarmonicProblem> duffing(test::Duffing d) {
  HarmonicProblem p{.K = Mat::Constant(1, 1, d.a),
                    .D = Mat::Constant(1, 1, 2.0 * d.zeta),
                    .loads = {{1.0, Vec::Constant(1, d.F), Vec::Zero(1)}},
                    .rate = d.w,
                    .scale = Vec::Ones(2)};
  p.forces.push_back(
      smooth_force("spring", Mat::Ones(1, 1), Mat::Ones(1, 1),
                   [b = d.b](double, const PortVec& u, const PortVec&, PortSample& s) {
                     s.g(0) = -b * u(0) * u(0) * u(0);
                     s.by_u(0, 0) = -3.0 * b * u(0) * u(0);
                     return true;
                   }));
  return std::make_shared<const HarmonicProblem>(std::move(p));
}

constexpr test::Duffing strong{.zeta = 0.05, .b = 0.7, .F = 0.3};
constexpr ContinuationOptions up{.low = 0.7, .high = 2.6, .first = 0.7, .largest_step = 0.05};

Branch duffing_branch(int harmonics) {
  const auto at = [](double w) {
    test::Duffing d = strong;
    d.w = w;
    return duffing(d);
  };
  const auto problem = at(up.first);
  const HarmonicOrbit orbit =
      find_harmonic_orbit(*problem, Mat::Zero(1, 1), {.harmonics = harmonics});
  EXPECT_TRUE(orbit.is_good()) << orbit.failure;
  return walk_to_the_end(
      {harmonic_equations(at, 1, harmonics, 1.0), harmonic_unknowns(orbit, 1.0), up});
}

// With one harmonic both folds are those of the closed form; between them the branch is unstable.
TEST(HarmonicBranch, OfOneHarmonicFoldsInClosedForm) {
  const Branch branch = duffing_branch(1);
  EXPECT_TRUE(branch.ends_as(EndKind::range)) << branch.end_text();
  const std::vector<double> folds = values(branch, fold);
  ASSERT_EQ(folds.size(), 2u);
  const auto [upper, lower] = test::harmonic_folds(strong.zeta, strong.b, strong.F);
  EXPECT_NEAR(folds[0], upper, 1e-7);
  EXPECT_NEAR(folds[1], lower, 1e-7);
  bool is_between = false;
  for (const BranchPoint& p : branch.points) {
    is_between = p.tangent(p.tangent.size() - 1) < 0.0;
    EXPECT_EQ(p.is_stable(), !is_between) << p.value;
  }
}

// With fifteen they are those of shooting, to what bifurcations are located to, and so are the
// multipliers there.
TEST(HarmonicBranch, FoldsWhereShootingDoes) {
  const Branch series = duffing_branch(15);
  const auto flow_at = [](double w) {
    test::Duffing d = strong;
    d.w = w;
    return d.flow();
  };
  const Branch shot = walk_to_the_end(orbit_continuation(flow_at, Vec(Vec::Zero(2)), up));
  const std::vector<double> a = values(series, fold), b = values(shot, fold);
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(a[std::size_t(i)], b[std::size_t(i)], 1e-7);
  EXPECT_EQ(series.bifurcations.size(), shot.bifurcations.size());
}

/// A scene with its problem.
struct At {
  Scene scene;
  HarmonicProblem problem;
  explicit At(Scene s) : scene(std::move(s)), problem(harmonic_problem(scene.contacts)) {}
};
std::shared_ptr<const HarmonicProblem> problem_of(const test::RotorStator& rotor) {
  const auto both = std::make_shared<const At>(rotor.scene());
  return {both, &both->problem};
}

// The residual is a formula: at displacements that are held it goes straight with stiffness,
// friction and unbalance, so that values far apart tell its slope. Rounding leaves the difference
// that branches take where they know no slope nearly nine digits of it.
TEST(HarmonicBranch, HasEightDigitsOfTheDerivativeByTheParameter) {
  constexpr int harmonics = 20;
  constexpr double eight_digits = 1e-8;
  struct Knob {
    const char* name;
    double test::RotorStator::*value;
    double low, high;
  };
  for (const Knob& knob : {Knob{"stiffness", &test::RotorStator::kC, 100e6, 200e6},
                           Knob{"friction", &test::RotorStator::mu, 0.05, 0.15},
                           Knob{"unbalance", &test::RotorStator::e, 0.5e-3, 1.5e-3}}) {
    SCOPED_TRACE(knob.name);
    const auto problem_at = [&](double value) {
      test::RotorStator rotor = test::P1;
      rotor.*knob.value = value;
      return problem_of(rotor);
    };
    const BranchEquations equations = harmonic_equations(problem_at, 1, harmonics, test::P1.gap);
    Vec x = Vec::Zero(2 * (2 * harmonics + 1));  // within the ring, beyond it for a while
    x.head(6) << 0.1, -0.4, 0.8, 0.1, 0.0, 0.9;
    const auto change = [&](double low, double high) -> Vec {
      const auto a = equations.at(x, low, WithTangent::no),
                 b = equations.at(x, high, WithTangent::no);
      EXPECT_EQ(a.residual.size(), x.size());
      return (b.residual - a.residual) / (high - low);
    };
    const double middle = 0.5 * (knob.low + knob.high);
    const double h = equations.difference * (knob.high - knob.low);
    const Vec exact = change(knob.low, knob.high), taken = change(middle - h, middle + h);
    EXPECT_GT(exact.norm(), 0.0);
    EXPECT_LT((taken - exact).norm(), eight_digits * exact.norm());
  }
}

// The rotor in its stator doubles its period as friction falls, contacts and all, where shooting
// says.
TEST(HarmonicBranch, FindsThePeriodDoublingOfARubbingRotor) {
  const auto at = [](double mu) {
    test::RotorStator p = test::P1;
    p.Omega = 138.4, p.kC = 64e6, p.mu = mu;
    return p;
  };
  const ContinuationOptions down{
      .low = 0.115, .high = 0.15, .first = 0.15, .direction = -1.0, .largest_step = 0.005};
  const auto first = std::make_shared<const Scene>(at(down.first).scene());
  Trajectory t{.system = &first->contacts,
               .state = test::start_of(at(down.first).model(), *first),
               .revolutions = 500};
  integrate_single(t, {});

  const FlowAt flow_at = [&](double mu) {
    return flow_of(std::make_shared<const Scene>(at(mu).scene()), *first);
  };
  const Branch shot = walk_to_the_end(orbit_continuation(flow_at, t.state.y, down));
  ASSERT_EQ(values(shot, period_doubling).size(), 1u);

  const HarmonicProblemAt problem_at = [&](double mu) { return problem_of(at(mu)); };
  const ContactOrbit orbit = find_harmonic_orbit(first->contacts, t.state.y, {.harmonics = 40});
  ASSERT_TRUE(orbit.orbit.is_good()) << orbit.orbit.failure;
  const double scale = first->contacts.length_scale();
  const Branch series = walk_to_the_end(
      {harmonic_equations(problem_at, 1, 40, scale), harmonic_unknowns(orbit.orbit, scale), down});
  EXPECT_TRUE(series.ends_as(EndKind::range)) << series.end_text();
  ASSERT_EQ(values(series, period_doubling).size(), 1u);
  constexpr double by_harmonics = 1e-3;  // of the friction, what 40 leave
  EXPECT_NEAR(values(series, period_doubling)[0], values(shot, period_doubling)[0], by_harmonics);
  EXPECT_TRUE(series.points.front().is_stable());
  EXPECT_FALSE(series.points.back().is_stable());
  EXPECT_EQ(series.points.front().contacts.at(0).impacts,
            shot.points.front().contacts.at(0).impacts);
}

}  // namespace whirl::harmonic_branch_test
