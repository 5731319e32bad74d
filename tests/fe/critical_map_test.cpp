// The critical speed map: branches that are whole, monotone and of one mode each.

#include "libfe/analyses/critical_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "libbase/error.hpp"
#include "libfe/analyses/shape_branches.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::critical_map_test {

using test::at;

constexpr double solves = 1e-9;  // relative; an eigenvalue of some dozen dofs

/// A shaft with two disks on bearings that differ from each other and between x and y.
Structure unequal() {
  Structure s = test::two_disk({});
  s.bearings = {test::bearing(at(0.0), test::orthotropic(4.4e5, 4.6e5)),
                test::bearing(at(1.5), test::orthotropic(9.5e5, 1.1e8))};
  return s;
}

/// A branch where it is one.
struct Followed {
  std::vector<double> x, speed;
};
Followed followed(const CriticalMap& map, const CriticalMapBranch& branch) {
  Followed all;
  for (std::size_t i = 0; i < map.x.size(); ++i) {
    if (std::isnan(branch.speed.at(i))) continue;
    all.x.push_back(map.x[i]);
    all.speed.push_back(branch.speed[i]);
  }
  return all;
}

// Above the rank of the changed stiffness nothing but rises is possible: w^2 = min max q^H K q /
// q^H M q grows with K, and no faster than K [Friswell2010]. A line that joins points of different
// modes falls, or rises too fast, somewhere.
void expect_whole(const CriticalMap& map) {
  constexpr double rounding = 1e-7;  // relative, of a speed that no longer changes
  ASSERT_FALSE(map.branches.empty());
  for (const CriticalMapBranch& branch : map.branches) {
    const Followed b = followed(map, branch);
    EXPECT_NEAR(b.x.front() / map.x.front(), 1.0, solves);  // none begins inside the picture
    if (b.x.back() < (1.0 - solves) * map.x.back()) {
      EXPECT_GT(b.speed.back(), map.top);  // it leaves at the top
    }
    for (std::size_t i = 1; i < b.x.size(); ++i) {
      EXPECT_GE(b.speed[i], (1.0 - rounding) * b.speed[i - 1]) << b.x[i];
      EXPECT_LE(b.speed[i] / b.speed[i - 1], (1.0 + rounding) * std::sqrt(b.x[i] / b.x[i - 1]))
          << b.x[i];
    }
  }
}

/// Speeds of all branches at a value of x, up to the top.
std::vector<double> speeds_at(const CriticalMap& map, double x) {
  std::vector<double> speeds;
  for (const CriticalMapBranch& b : map.branches) {
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      if (std::abs(map.x[i] / x - 1.0) < solves && b.speed[i] <= map.top)
        speeds.push_back(b.speed[i]);
    }
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

TEST(CriticalMap, OfUnequalAnisotropicBearingsHasWholeBranches) {
  const CriticalMap map = critical_map(unequal(), {});
  EXPECT_FALSE(map.is_common);
  EXPECT_TRUE(map.gaps.empty());
  expect_whole(map);
}

// At a factor of one the map shows the critical speeds of the model, all of them, each once.
TEST(CriticalMap, ShowsTheCriticalSpeedsOfTheModel) {
  const CriticalMap map = critical_map(unequal(), {});
  const std::vector<double> found = speeds_at(map, 1.0);
  const auto criticals = critical_speeds(Assembler(unequal()), {.count = 12});
  ASSERT_GT(found.size(), 4u);
  ASSERT_LT(found.size(), criticals.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], criticals[i].speed, solves * found[i]) << i;
  }
  EXPECT_GT(criticals[found.size()].speed, map.top);
}

// A mass m on springs k, four of them equal: Omega = sqrt(k / m) forward and backward alike, a
// double speed at every stiffness, and both branches go through the whole map.
TEST(CriticalMap, FollowsEqualSpeedsAsTwoBranches) {
  const double m = 2.0, k = 2e4;
  const Structure s{.bodies = {{.name = "rotor", .m = m, .spins = true}},
                    .bearings = {test::bearing(test::body("rotor"), test::isotropic(k, 4.0))}};
  const CriticalMap map = critical_map(s, {.critical = {.count = 2}});
  EXPECT_TRUE(map.is_common);
  ASSERT_EQ(map.branches.size(), 2u);
  expect_whole(map);
  for (const CriticalMapBranch& b : map.branches) {
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      EXPECT_NEAR(b.speed[i], std::sqrt(map.x[i] / m), solves * b.speed[i]);
    }
  }
  // both cross the bearing's own stiffness at the critical speed
  ASSERT_EQ(map.curves.size(), 1u);
  ASSERT_EQ(map.crossings.size(), 2u);
  for (const StiffnessCrossing& c : map.crossings) {
    EXPECT_NEAR(c.stiffness, k, 1e-8 * k);
    EXPECT_NEAR(c.speed, std::sqrt(k / m), 1e-8 * c.speed);
  }
}

// With isotropic bearings forward and backward whirl do not mix: branches of both senses cross, and
// every crossing with a stiffness that rises with speed is a critical speed of that bearing.
TEST(CriticalMap, CrossesATableWhereTheModelIsCritical) {
  const TableBearing table{
      {.speed = {0.0, 400.0, 4000.0},
       .rows = {test::isotropic(1e6), test::isotropic(3e6), test::isotropic(2e7)}}};
  Structure s = test::two_disk({});
  s.bearings = {test::bearing(at(0.0), AnyBearing(table)),
                test::bearing(at(1.5), AnyBearing(table))};
  const CriticalMap map = critical_map(s, {});
  expect_whole(map);
  const auto criticals = critical_speeds(Assembler(s), {.count = 6});
  ASSERT_GE(criticals.size(), 4u);
  for (const Critical& critical : criticals) {
    const bool is_there =
        std::any_of(map.crossings.begin(), map.crossings.end(), [&](const StiffnessCrossing& c) {
          return std::abs(c.speed - critical.speed) < 1e-7 * c.speed;
        });
    EXPECT_TRUE(is_there || critical.speed > map.top) << critical.speed;
  }
}

TEST(CriticalMap, OfRigidBearingsIsEmpty) {
  Structure s = test::two_disk({});
  s.bearings = {test::rigid(at(0.0)), test::rigid(at(1.5))};
  EXPECT_TRUE(critical_map(s, {}).branches.empty());
}

// Two solutions whose shapes turn into each other and whose values cross: 2 x 2 with
//   value = 2 +- r,  shapes (cos a, sin a), (-sin a, cos a),  tan 2 a = c / (t - 1/2)
// r = hypot(t - 1/2, c). The values do not meet; the upper branch stays the upper one, however
// fast the shapes turn within one step.
TEST(FollowShapes, LooksCloserWhereShapesTurnWithinAStep) {
  const double c = 0.01;
  int solved = 0;
  const SolveShapes solve = [&](double t) {
    ++solved;
    const double r = std::hypot(t - 0.5, c), a = 0.5 * std::atan2(c, t - 0.5);
    return std::vector<ShapedValue>{{2.0 - r, Eigen::Vector2cd(-std::sin(a), std::cos(a))},
                                    {2.0 + r, Eigen::Vector2cd(std::cos(a), std::sin(a))}};
  };
  Sparse W(2, 2);
  W.setIdentity();
  const ShapeBranches found = follow_shapes({0.0, 0.25, 0.495, 1.0}, solve, W, 10.0);
  ASSERT_EQ(found.branches.size(), 2u);
  for (const ShapedValue& v : found.branches[0].found) EXPECT_LT(v.value, 2.0);
  for (const ShapedValue& v : found.branches[1].found) EXPECT_GT(v.value, 2.0);
  EXPECT_GT(solved, 4);
}

// Two of three values are equal, and the solver turns their shapes at will within their plane: each
// branch keeps its own shape. The two values differ by 1e-11 of their size, less than the 1e-9 of
// it that counts as equal, but by more than 1e-9 itself.
TEST(FollowShapes, KeepsTheShapesOfEqualValuesThatASolverTurns) {
  const SolveShapes solve = [](double t) {
    const double a = 0.3 + 5.0 * t, c = std::cos(a), s = std::sin(a);
    return std::vector<ShapedValue>{{1e5, Eigen::Vector3cd(c, s, 0.0)},
                                    {1e5 + 1e-6, Eigen::Vector3cd(-s, c, 0.0)},
                                    {2e5, Eigen::Vector3cd(0.0, 0.0, 1.0)}};
  };
  Sparse W(3, 3);
  W.setIdentity();
  const ShapeBranches found = follow_shapes({0.0, 0.1, 0.2, 0.3, 0.4}, solve, W, 1e6);
  ASSERT_EQ(found.branches.size(), 3u);
  for (const ShapeBranch& branch : found.branches) {
    ASSERT_EQ(branch.at.size(), 5u);
    for (const ShapedValue& v : branch.found) {
      EXPECT_NEAR(std::abs(v.shape.dot(branch.found[0].shape)), 1.0, 1e-12);
    }
  }
}

TEST(FollowShapes, GoesOnBeyondAnEigenproblemThatFails) {
  const SolveShapes solve = [](double t) {
    if (t == 2.0) throw NumericalError("it does not converge");
    std::vector<ShapedValue> found{{1.0 + t, Eigen::Vector2cd(1.0, 0.0)},
                                   {2.5, Eigen::Vector2cd(0.0, 1.0)}};
    if (t > 1.5) std::swap(found[0], found[1]);
    return found;
  };
  Sparse W(2, 2);
  W.setIdentity();
  ShapeBranches found;
  found = follow_shapes({0.0, 1.0, 2.0, 3.0}, solve, W, 10.0);
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_EQ(found.branches[0].at, (std::vector<double>{0.0, 1.0, 3.0}));
  EXPECT_EQ(found.branches[0].found.back().value, 4.0);  // the one that crosses the other
  ASSERT_EQ(found.gaps.size(), 1u);
  EXPECT_EQ(found.gaps[0].at, 2.0);
  EXPECT_EQ(found.gaps[0].reason, "it does not converge");
}

// Shapes that turn by 60 degrees in a step are looked at between, where there is nothing here:
// nobody asked for these values, and they are no gaps.
TEST(FollowShapes, DoesNotTellGapsBetweenTheValues) {
  int refused = 0;
  const SolveShapes solve = [&](double t) {
    if (t != std::round(t)) {
      ++refused;
      throw ModelError({}, "", "expected a whole number");
    }
    const double a = t * std::numbers::pi / 3.0;
    return std::vector<ShapedValue>{{1.0, Eigen::Vector2cd(std::cos(a), std::sin(a))},
                                    {2.0, Eigen::Vector2cd(-std::sin(a), std::cos(a))}};
  };
  Sparse W(2, 2);
  W.setIdentity();
  const ShapeBranches found = follow_shapes({0.0, 1.0, 2.0}, solve, W, 10.0);
  EXPECT_GT(refused, 0);
  EXPECT_TRUE(found.gaps.empty());
}

// A mass m on a film of stiffness k0 + a Omega, the same along x and y: critical where
// m Omega^2 = k0 + a Omega. The map goes over a stiffness that stands for the film, and the film's
// own crosses it there; without speeds to look at films are left out.
TEST(CriticalMap, CrossesAFilmWhereTheModelIsCritical) {
  const double m = 3.0, k0 = 2e5, a = 400.0;
  Structure s{.bodies = {{.name = "rotor", .m = m, .spins = true}}};
  s.linearized.push_back({"film", test::body("rotor"), test::ground(), [&](double Omega, double) {
                            if (Omega < 40.0) throw NumericalError("no film");
                            return test::isotropic(k0 + a * Omega, 50.0);
                          }});
  EXPECT_TRUE(critical_map(s, {.critical = {.count = 2}}).branches.empty());
  const CriticalMap map =
      critical_map(s, {.critical = {.count = 2}, .film_speeds = {5.0, 100.0, 500.0}});
  EXPECT_TRUE(map.is_common);
  expect_whole(map);
  const double critical = (a + std::sqrt(a * a + 4.0 * m * k0)) / (2.0 * m);
  ASSERT_EQ(map.curves.size(), 1u);  // x and y are alike
  EXPECT_EQ(map.curves[0].name, "Kxx, Kyy");
  EXPECT_LT(map.curve_speeds.front(), 40.0);
  for (std::size_t i = 0; i < map.curve_speeds.size(); ++i) {
    const double Omega = map.curve_speeds[i], k = map.curves[0].stiffness[i];
    if (Omega < 40.0) {
      EXPECT_TRUE(std::isnan(k)) << Omega;
    } else {
      EXPECT_NEAR(k, k0 + a * Omega, 1e-14 * k);
    }
  }
  ASSERT_EQ(map.crossings.size(), 2u);
  for (const StiffnessCrossing& c : map.crossings) {
    EXPECT_NEAR(c.speed, critical, 1e-8 * critical);
    EXPECT_NEAR(c.stiffness, m * critical * critical, 1e-7 * c.stiffness);
  }
}

// A pedestal stands on the same spring as a bearing of a body and as a link: the map is the same,
// and sweeps what ends on the shaft only. It swept the spring below the pedestal before, too.
TEST(CriticalMap, LeavesFoundationsAsTheyAre) {
  Structure by_bearing = test::two_disk({});
  by_bearing.bodies = {{.name = "pedestal", .m = 20.0}};
  Connection left = test::bearing(at(0.0), test::isotropic(5e6));
  left.name = "left", left.to = test::body("pedestal");
  Connection right = test::bearing(at(1.5), test::isotropic(5e6));
  right.name = "right";
  Connection foot = test::bearing(test::body("pedestal"), test::isotropic(9e6));
  foot.name = "foot";
  by_bearing.bearings = {left, right};
  Structure by_link = by_bearing;
  by_bearing.bearings.push_back(foot);
  by_link.links = {foot};
  const CriticalMap map = critical_map(by_bearing, {}), other = critical_map(by_link, {});
  EXPECT_TRUE(map.is_common);
  EXPECT_EQ(map.swept, "left, right");
  EXPECT_EQ(map.x, other.x);
  ASSERT_EQ(map.branches.size(), other.branches.size());
  for (std::size_t b = 0; b < map.branches.size(); ++b) {
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      const double one = map.branches[b].speed[i], two = other.branches[b].speed[i];
      if (std::isnan(one) && std::isnan(two)) continue;
      EXPECT_NEAR(one, two, solves * two) << b << ", " << map.x[i];
    }
  }
}

}  // namespace whirl::critical_map_test
