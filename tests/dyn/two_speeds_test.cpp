// Critical speeds in the plane of the speeds of two shafts, in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/own_speed_branches.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::two_speeds_test {

constexpr double Id = 0.01, Ip = 0.006, kt = 900.0;
constexpr double solves = 1e-9;  // relative

/// A body that turns with a further shaft and tilts on springs, and one of the first shaft:
///
///   Id theta'' - i Ip w theta' + kt theta = 0,   theta = theta_x + i theta_y
Model tilting(double own) {
  Model model;
  Structure& s = model.structure;
  s.rotors = {{.name = "lp", .ratio = 1.0}, {.name = "hp", .lead = {0.0}, .own = {own}}};
  for (const std::string shaft : {"hp", "lp"}) {
    const double size = shaft == "hp" ? 1.0 : 4.0;
    s.bodies.push_back({.name = shaft,
                        .m = 1.0,
                        .spins = true,
                        .rotor = shaft,
                        .tilts = true,
                        .Id = size * Id,
                        .Ip = size * Ip});
    BearingCoefficients springs = test::isotropic(1e9);
    springs.Kt.diagonal().setConstant(kt);
    s.bearings.push_back(test::bearing(test::body(shaft), springs));
  }
  model.speed = 100.0;
  return model;
}

/// Natural frequency of whirl of the body of hp where that turns with w, forward 1, backward -1.
double natural(double w, double sense) {
  const double half = sense * 0.5 * Ip * w / Id;
  return half + std::sqrt(half * half + kt / Id);
}

std::vector<double> numbers(double first, double last, int steps) {
  std::vector<double> all;
  for (int i = 0; i <= steps; ++i) all.push_back(first + (last - first) * i / steps);
  return all;
}

// By the first shaft: its speed is a natural frequency at the value, or that of its own body,
// sqrt(kt / (4 (Id -+ Ip))). By the further one: its speed is that of its body or of the other one
// at the speed of the first shaft.
TEST(TwoSpeeds, AreAPlaneOfCriticalSpeeds) {
  const CriticalOver found =
      critical_over(tilting, {"rotor.hp.speed", "rad/s"}, numbers(60.0, 660.0, 12), {.count = 4});
  EXPECT_EQ(found.shaft, "hp");
  ASSERT_EQ(found.branches.size(), 4u);
  const double slow = std::sqrt(kt / (4.0 * (Id + Ip))), fast = std::sqrt(kt / (4.0 * (Id - Ip)));
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    std::vector<double> expected{slow, fast, natural(found.values[i], -1.0),
                                 natural(found.values[i], 1.0)};
    std::vector<double> speeds;
    for (const CriticalOverBranch& branch : found.branches) {
      EXPECT_EQ(branch.shaft, "shaft");
      speeds.push_back(branch.speed(static_cast<Eigen::Index>(i)));
    }
    std::ranges::sort(expected);
    std::ranges::sort(speeds);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(speeds[k], expected[k], solves * expected[k]);
  }

  EXPECT_EQ(found.lead_speeds.front(), 0.0);
  EXPECT_NEAR(found.lead_speeds.back(), natural(660.0, 1.0), 1e-6);
  std::vector<Vec> own;
  for (const OwnSpeedBranch& branch : found.own_branches) {
    ASSERT_EQ(branch.speed.size(), std::ssize(found.lead_speeds));
    own.push_back(branch.speed);
  }
  // both of its body, and the other's: at 4 Id the frequencies are half as high
  ASSERT_EQ(own.size(), 4u);
  for (std::size_t i = 0; i < found.lead_speeds.size(); ++i) {
    const double half = 0.5 * Ip * found.lead_speeds[i] / Id, root = std::hypot(half, 150.0);
    std::vector<double> expected{std::sqrt(kt / (Id + Ip)), std::sqrt(kt / (Id - Ip)), root - half,
                                 root + half};
    std::vector<double> speeds;
    for (const Vec& speed : own) {
      const double x = speed(static_cast<Eigen::Index>(i));
      if (std::isfinite(x)) speeds.push_back(x);
    }
    std::erase_if(expected, [](double x) { return x < 60.0 || x > 660.0; });
    std::ranges::sort(expected);
    std::ranges::sort(speeds);
    ASSERT_EQ(speeds.size(), expected.size()) << found.lead_speeds[i];
    for (std::size_t k = 0; k < speeds.size(); ++k) {
      EXPECT_NEAR(speeds[k], expected[k], solves * expected[k]);
    }
  }
}

// Against the first shaft the same plane is seen in a mirror.
TEST(TwoSpeeds, OfAShaftThatTurnsAgainstItAreMirrored) {
  const CriticalOver along =
      critical_over(tilting, {"rotor.2.speed", "rad/s"}, numbers(100.0, 600.0, 5), {.count = 4});
  const CriticalOver against =
      critical_over(tilting, {"rotor.2.speed", "rad/s"}, numbers(-600.0, -100.0, 5), {.count = 4});
  ASSERT_EQ(along.own_branches.size(), against.own_branches.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < along.own_branches.size(); ++i) {
    const Vec both = along.own_branches[i].speed + against.own_branches[i].speed;
    for (const double x : both) sum = std::max(sum, std::isfinite(x) ? std::abs(x) : 0.0);
  }
  EXPECT_LT(sum, solves * 600.0);
}

// Another value has no plane: branches by a further shaft of another ratio stand beside those by
// the first one.
TEST(TwoSpeeds, OverARatioHaveBranchesByEachShaft) {
  const ModelAt at = [](double ratio) {
    Model model = tilting(1.0);
    Rotor& hp = model.structure.rotors[1];
    hp.lead.clear(), hp.own.clear();
    hp.ratio = ratio;
    return model;
  };
  const CriticalOver found =
      critical_over(at, {"rotor.hp.ratio", ""}, numbers(1.2, 1.6, 4), {.count = 2});
  EXPECT_TRUE(found.shaft.empty() && found.own_branches.empty());
  std::size_t by_hp = 0;
  for (const CriticalOverBranch& branch : found.branches) {
    if (branch.shaft != "hp") continue;
    ++by_hp;
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      CriticalOptions options{.count = 4, .by = "hp"};
      double nearest = 1e9;
      for (const Critical& c : critical_speeds(Assembler(at(found.values[i]).structure), options)) {
        nearest = std::min(nearest, std::abs(c.speed - branch.speed(static_cast<Eigen::Index>(i))));
      }
      EXPECT_LT(nearest, solves * 300.0);
    }
  }
  EXPECT_EQ(by_hp, 2u);
  EXPECT_FALSE(rotor_of_speed(at(1.2).structure, "rotor.hp.ratio"));
  EXPECT_EQ(rotor_of_speed(at(1.2).structure, "rotor.hp.speed"), 1u);
}

}  // namespace whirl::two_speeds_test
