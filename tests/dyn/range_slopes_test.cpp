// Derivatives of motions by a parameter from a few systems of its range: against differences in
// quadruple precision, against those that branches took, and where there are none.

#include "libdyn/branches/range_slopes.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/branch_trees.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl::range_slopes_test {

/// Relative errors of slopes.
constexpr double seven_digits = 1e-7, nine_digits = 1e-9, ten_digits = 1e-10;

/// A parameter of the rotor in its stator, its range, and a value in it.
struct Case {
  std::string name;
  test::RotorStator rotor;
  std::function<void(test::RotorStator&, double)> set;
  double low = 0.0, high = 0.0, value = 0.0;
  std::size_t secants = 2;  ///< of the panel of the value
  double asked = nine_digits;

  test::RotorStator at(double p) const {
    test::RotorStator changed = rotor;
    set(changed, p);
    return changed;
  }
  std::shared_ptr<const Scene> scene(double p) const {
    return std::make_shared<const Scene>(at(p).scene());
  }
  RangeSlopes slopes() const {
    return {[*this](double p) { return scene(p); }, scene(value), low, high};
  }
  /// On the steady motion of the value, at phase 0.
  Vec start() const {
    const auto now = scene(value);
    Trajectory t{.system = &now->contacts,
                 .state = test::start_of(at(value).model(), *now),
                 .revolutions = 50};
    integrate_single(t, {});
    return t.state.y;
  }
};

std::vector<Case> cases() {
  using R = test::RotorStator;
  const R damped{.Omega = 136.0, .kC = 150e6, .mu = 0.1, .cC = 2e4};
  const R hertz{.Omega = 136.0, .mu = 0.1, .kH = 2e9, .alpha = 0.02};
  return {
      {"stiffness", test::P1, [](R& r, double p) { r.kC = p; }, 100e6, 200e6, 150e6},
      {"damping", damped, [](R& r, double p) { r.cC = p; }, 1e4, 5e4, 2e4},
      {"hertz stiffness", hertz, [](R& r, double p) { r.kH = p; }, 1e9, 3e9, 2e9},
      // it does little, and steps begin 1e-8 of the clearance below the surface
      {"dissipation", hertz, [](R& r, double p) { r.alpha = p; }, 0.01, 0.05, 0.02, 2,
       seven_digits},
      {"friction from none on", test::P1, [](R& r, double p) { r.mu = p; }, 0.0, 0.2, 0.1},
      {"clearance", test::P1, [](R& r, double p) { r.gap = p; }, 5e-3, 7e-3, 6e-3},
      {"unbalance", test::P1, [](R& r, double p) { r.e = p; }, 0.5e-3, 1.5e-3, 1e-3},
      {"spring", test::P1, [](R& r, double p) { r.kr = p; }, 900e3, 1100e3, 980e3},
      {"speed", test::P1, [](R& r, double p) { r.Omega = p; }, 130.0, 150.0, 136.0, 8},
      {"mass, far", test::P1, [](R& r, double p) { r.mr = p; }, 20.0, 100.0, 50.0, 8},
  };
}

/// Change of the end of a revolution over that of the parameter, of the fourth order.
Vec quad_slope(const Case& c, const Vec& start, double h) {
  const auto change = [&](double by) {
    Vec sum = Vec::Zero(start.size());
    for (const double sign : {1.0, -1.0}) {
      const auto beside = c.scene(c.value + sign * by);
      Trajectory t{.system = &beside->contacts, .revolutions = 1};
      t.state.y = start;
      integrate_quad(t, {.tolerance = 1e-19, .order = 22});
      EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
      sum += sign * t.state.y + sign * t.lower_digits;
    }
    return sum;
  };
  return (8.0 * change(h) - change(2.0 * h)) / (12.0 * h);
}

/// A difference of motions as branches take it.
Vec plain_slope(const Case& c, const Vec& start, double h) {
  const auto end = [&](double p) {
    return flow_of(c.scene(p), *c.scene(c.value)).go({&start, 1}, 1, WithTangent::no)[0].end;
  };
  return (end(c.value + h) - end(c.value - h)) / (2.0 * h);
}

double error(const Vec& slope, const Vec& exact, const Vec& scale) {
  return (slope - exact).cwiseQuotient(scale).norm() / exact.cwiseQuotient(scale).norm();
}

// Impacts let errors of the motion grow: nine digits are left in doubles, or ten. Those of
// differences are noise of the motions, or of their curvature.
TEST(RangeSlopes, AreThoseOfMotionsInQuadruplePrecision) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const RangeSlopes slopes = c.slopes();
    const Vec start = c.start(), scale = c.scene(c.value)->contacts.state_scale();
    const auto panel = slopes.panel_at(c.value);
    ASSERT_TRUE(panel);
    EXPECT_EQ(panel->secants().size(), c.secants);
    const auto slope = slopes.end_slope(c.value, test::state_of(start), 1.0);
    ASSERT_TRUE(slope);
    const Vec wanted = quad_slope(c, start, 1e-5 * c.value);
    EXPECT_LT(error(*slope, wanted, scale), c.asked);
    const Vec plain = plain_slope(c, start, 3e-6 * (c.high - c.low));
    EXPECT_GT(error(plain, wanted, scale), 2.0 * error(*slope, wanted, scale));
  }
}

// Neighbors of the value itself say the same slopes of all numbers; of a ring that is not met,
// zero.
TEST(RangeSlopes, AreThoseOfNeighbors) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const RangeSlopes slopes = c.slopes();
    const MotionState start = test::state_of(c.start());
    for (const double share : {0.03, 0.41, 0.97}) {
      const double value = c.low + share * (c.high - c.low);
      const auto scene = c.scene(value);
      const auto slope = slopes.end_slope(value, start, 1.0);
      ASSERT_TRUE(slope);
      const std::vector<SystemSlope> beside{
          slope_of(c.name, value, 0.0, [&](double p) { return c.scene(p)->contacts; })};
      const double time = scene->contacts.period();
      const MotionSlopes motion =
          motion_slopes(scene->contacts, start, {&time, 1}, beside,
                        {.tolerance = 1e-14, .by_start = false, .held = HeldSample::phase});
      const Vec to_scale = scene->contacts.state_scale().cwiseInverse();
      const Vec wanted = motion.by_parameter[0].col(0).cwiseProduct(to_scale);
      EXPECT_LE((slope->cwiseProduct(to_scale) - wanted).norm(), ten_digits * wanted.norm());
    }
  }
}

// Panels are halves of halves, whichever value is asked for first.
TEST(RangeSlopes, DoNotDependOnWhatWasAskedBefore) {
  const Case c = cases().back();
  const RangeSlopes upward = c.slopes(), downward = c.slopes();
  const MotionState start = test::state_of(c.start());
  std::vector<Vec> up, down;
  for (const double p : {21.0, 40.0, 99.0}) up.push_back(*upward.end_slope(p, start, 1.0));
  for (const double p : {99.0, 40.0, 21.0}) down.push_back(*downward.end_slope(p, start, 1.0));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(up[i], down[2 - i]);
}

RangeSlopes of_rotors(const std::function<Scene(double)>& at, double low, double high) {
  const auto scene = [at](double p) { return std::make_shared<const Scene>(at(p)); };
  return {scene, scene(0.5 * (low + high)), low, high};
}

TEST(RangeSlopes, AreNotThereWhereTheyWouldBeWrongOrDear) {
  const auto two_disk = [](int modes) {
    return [modes](double k) { return test::TwoDiskRub{.k = k, .modes = modes}.scene(); };
  };
  EXPECT_FALSE(of_rotors(two_disk(8), 3e6, 5e6).panel_at(4e6)) << "modes change, without models";
  EXPECT_TRUE(of_rotors(two_disk(0), 3e6, 5e6).panel_at(4e6)) << "every freedom";
  const auto has_end_slope = [](const RangeSlopes& slopes, const Scene& scene, double value) {
    const MotionState start = test::state_of(Vec::Zero(scene.contacts.size()));
    return slopes.end_slope(value, start, 1.0).has_value();
  };
  const auto ring = [](double k) { return test::RotorStator{.kC = k}.scene(); };
  EXPECT_TRUE(has_end_slope(of_rotors(ring, 1e8, 3e8), ring(2e8), 2e8));
  const auto film = [](double viscosity) {
    return test::TwoDisksOnFilms{.viscosity = viscosity}.scene();
  };
  EXPECT_FALSE(has_end_slope(of_rotors(film, 0.01, 0.03), film(0.02), 0.02));
  // no system to either side of a jump of its numbers is one of a polynomial
  const auto jumps = [](double k) {
    return test::RotorStator{.kC = k < 120e6 ? k : 2.0 * k}.scene();
  };
  const RangeSlopes broken = of_rotors(jumps, 100e6, 200e6);
  EXPECT_FALSE(broken.panel_at(120.1e6));
  EXPECT_TRUE(broken.panel_at(190e6));
  // beside no friction at all there is friction that sticks
  const Case friction = cases()[4];
  ASSERT_EQ(friction.low, 0.0);
  EXPECT_FALSE(friction.slopes().end_slope(0.0, test::state_of(friction.start()), 1.0));
}

// Seen from the rotor a motion begins at a phase that its period tells, whatever the speed.
TEST(RangeSlopes, AreThoseOfMotionsSeenFromTheRotor) {
  const auto at = [](double speed) { return test::TwoDiskRub{.speed = speed}.scene(); };
  const double speed = test::TwoDiskRub{}.speed, h = 1e-5 * speed, revolutions = 2.2;
  const auto scene = [&](double p) { return std::make_shared<const Scene>(at(p)); };
  const auto first = scene(speed);
  Vec z = first->contacts.state_scale();
  z = z.cwiseProduct(Vec::LinSpaced(z.size(), 0.2, 4.0).array().sin().matrix());
  const auto end = [&](double p) {
    const AutonomousFlow flow = rotating_flow(scene(p), *first);
    return flow.go(z, revolutions * flow.revolution, WithTangent::no).end;
  };
  const RangeSlopes slopes(scene, first, 0.9 * speed, 1.1 * speed);
  const auto slope = slopes.end_slope(speed, rotating_start(*first, z, revolutions), revolutions);
  ASSERT_TRUE(slope);
  const Vec plain =
      (8.0 * (end(speed + h) - end(speed - h)) - (end(speed + 2.0 * h) - end(speed - 2.0 * h))) /
      (12.0 * h);
  constexpr double of_difference = 1e-6;
  EXPECT_LT(error(*slope, plain, first->contacts.state_scale()), of_difference);
}

/// A rotor whose shapes a parameter changes.
struct Reshaped {
  std::string name;
  std::function<Model(double)> model;
  double low = 0.0, high = 0.0, value = 0.0;

  std::shared_ptr<const Scene> scene(double p) const {
    return std::make_shared<const Scene>(make_scene(model(p), ReductionEstimate::no));
  }
  RangeSlopes slopes() const {
    return {[*this](double p) { return scene(p); }, scene(0.3 * low + 0.7 * high), low, high,
            model};
  }
};

std::vector<Reshaped> reshaped() {
  const auto two_disk = [](double k, double M, ReductionMethod method) {
    Model m = test::TwoDiskRub{.k = k, .modes = 8, .gravity = 9.81}.model();
    m.structure.disks[1].m = M;
    m.reduction.method = method;
    return m;
  };
  using enum ReductionMethod;
  return {{"bearings", [=](double k) { return two_disk(k, 5.0, modal); }, 3e6, 5e6, 4.1e6},
          {"mass", [=](double M) { return two_disk(4e6, M, modal); }, 4.0, 6.0, 4.7},
          {"static shapes", [=](double k) { return two_disk(k, 5.0, modal_residual); }, 3e6, 5e6,
           4.1e6}};
}

// Shapes that change with the parameter are told in coordinates in which they change smoothly: the
// derivative is that of the reduced equations, whatever signs and order their modes have.
TEST(RangeSlopes, AreThoseOfHarmonicBalanceWhereShapesChange) {
  constexpr int harmonics = 8;
  for (const Reshaped& c : reshaped()) {
    SCOPED_TRACE(c.name);
    const auto at = c.scene(c.value);
    const HarmonicProblem problem = harmonic_problem(at->contacts);
    const HarmonicEquations equations(problem, 1, harmonics);
    Mat u = Mat::Zero(2, 2 * harmonics + 1);  // within the ring, beyond it for a while
    u.leftCols(5) << 1.0e-3, 4.5e-3, 0.4e-3, 1.0e-3, 0.2e-3,  //
        -0.5e-3, 0.3e-3, 4.0e-3, 0.1e-3, 0.8e-3;
    const RangeSlopes slopes = c.slopes();
    const auto by = slopes.problem_slope(c.value);
    ASSERT_TRUE(by);
    const auto slope = equations.slope(u, equations.evaluate(u, false).g, *by);
    ASSERT_TRUE(slope);
    const auto residual = [&](double p) -> Mat {
      const auto there = c.scene(p);
      const HarmonicProblem beside = harmonic_problem(there->contacts);
      return HarmonicEquations(beside, 1, harmonics).evaluate(u, false).residual;
    };
    const double h = 1e-2 * c.value;  // shapes are solved for: rounding asks for a long stencil
    Mat wanted = Mat::Zero(u.rows(), u.cols());
    for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
      wanted += neighbor_weights[j] / h * residual(c.value + neighbor_places[j] * h);
    }
    EXPECT_LT((*slope - wanted).norm(), nine_digits * wanted.norm());
  }
}

// And that of motions, which begin and end in the coordinates of the first scene.
TEST(RangeSlopes, AreThoseOfMotionsWhereShapesChange) {
  const Reshaped c = reshaped()[0];
  const auto first = c.scene(0.5 * (c.low + c.high));
  const RangeSlopes slopes([&](double p) { return c.scene(p); }, first, c.low, c.high, c.model);
  Vec y = first->contacts.state_scale();
  y = y.cwiseProduct(Vec::LinSpaced(y.size(), 0.2, 4.0).array().sin().matrix());
  const auto slope = slopes.end_slope(c.value, test::state_of(y), 1.0);
  ASSERT_TRUE(slope);
  const auto end = [&](double p) {
    return flow_of(c.scene(p), *first, 1e-15).go({&y, 1}, 1, WithTangent::no)[0].end;
  };
  const double h = 2e-3 * c.value;
  Vec wanted = Vec::Zero(y.size());
  for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
    wanted += neighbor_weights[j] / h * end(c.value + neighbor_places[j] * h);
  }
  constexpr double of_difference = 1e-6;  // of motions in doubles
  EXPECT_LT(error(*slope, wanted, first->contacts.state_scale()), of_difference);
}

// Branches and their bifurcations stay where they were: each is a solution of the same equations.
void expect_branches_where_they_are(const BranchTreeOptions& options) {
  const test::DoublingRotor rotor;
  const BranchScenes exact = rotor.all_scenes();
  BranchScenes plain = exact;
  ASSERT_TRUE(exact.along.slopes->panel_at(options.along.first));
  plain.along.slopes = nullptr;
  const BranchTree begun = rotor.begun(options);
  const auto walked = [&](const BranchScenes& scenes) {
    return test::followed(scenes, {.tree = begun}, {.tree = options}).tree;
  };
  const BranchTree a = walked(plain), b = walked(exact);
  constexpr double same = 1e-9;  // of the range, to which bifurcations are located
  ASSERT_EQ(a.branches.size(), b.branches.size());
  for (std::size_t k = 0; k < a.branches.size(); ++k) {
    const Branch &x = a.branches[k].branch, &y = b.branches[k].branch;
    EXPECT_EQ(x.end_text(), y.end_text());
    EXPECT_EQ(x.points.size(), y.points.size());
    ASSERT_EQ(x.bifurcations.size(), y.bifurcations.size());
    for (std::size_t i = 0; i < x.bifurcations.size(); ++i) {
      EXPECT_EQ(x.bifurcations[i].kind, y.bifurcations[i].kind);
      EXPECT_NEAR(x.bifurcations[i].at.value, y.bifurcations[i].at.value,
                  2.0 * same * (options.along.high - options.along.low));
    }
  }
}
TEST(RangeSlopes, LeaveBranchesWhereTheyAre) {
  expect_branches_where_they_are(test::DoublingRotor().options());
}
TEST(RangeSlopes, LeaveBranchesOfSeriesWhereTheyAre) {
  BranchTreeOptions series = test::DoublingRotor().options();
  series.method = OrbitMethod::harmonic_balance;
  series.harmonics = 40;
  series.generations = 0;
  series.along.goes_both = false;
  expect_branches_where_they_are(series);
}

}  // namespace whirl::range_slopes_test
