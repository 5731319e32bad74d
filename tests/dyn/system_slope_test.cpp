// Slopes of a system's numbers by a parameter: of the stencil, of where it asks for neighbors, and
// of numbers whose derivatives are known.

#include "libdyn/system/system_slope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/number_slopes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::system_slope_test {

using test::MassInRing;
using test::RotorStator;

constexpr double of_slopes = 1e-11;  ///< relative: 1e-16 of a number over steps of 1 % of it

// Exact for polynomials up to the eighth degree.
TEST(SystemSlope, WeighsItsNeighborsToTheEighthOrder) {
  const auto slope = [](const auto& f) {
    double sum = 0.0;
    for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
      sum += neighbor_weights[j] * f(neighbor_places[j]);
    }
    return sum;
  };
  for (int power = 0; power <= 8; ++power) {
    const double found = slope([&](double x) { return std::pow(x + 1.0, power); });
    EXPECT_NEAR(found, power, 1e-9) << power;  // by terms up to 5^8
  }
  // the error of x^9 is step^8 c^(9) / 630 = 9! / 630
  EXPECT_NEAR(std::abs(slope([](double x) { return std::pow(x, 9); })), 576.0, 1e-9);
  EXPECT_EQ(*std::max_element(neighbor_places.begin(), neighbor_places.end()), farthest_neighbor);
}

TEST(SystemSlope, AsksForNeighborsNearTheValue) {
  const Scene scene = MassInRing{}.scene();
  const struct {
    double value, size, compared;
  } cases[] = {{3.0, 0.0, 3.0}, {-3.0, 0.0, 3.0}, {0.0, 10.0, 10.0}, {1e6, 2.0, 2.0}};
  for (const auto& [value, size, compared] : cases) {
    std::vector<double> asked;
    const SystemSlope slope = slope_of("p", value, size, [&](double p) {
      asked.push_back(p);
      return scene.contacts;
    });
    EXPECT_EQ(slope.name, "p");
    EXPECT_LE(slope.step, largest_step * compared);
    EXPECT_GT(slope.step, 0.5 * largest_step * compared);
    ASSERT_EQ(asked.size(), neighbor_places.size());
    EXPECT_EQ(slope.neighbors.size(), asked.size());
    for (std::size_t j = 0; j < asked.size(); ++j) {
      EXPECT_EQ(asked[j], value + neighbor_places[j] * slope.step);
    }
  }
  EXPECT_THROW(slope_of("p", 0.0, 0.0, [&](double) { return scene.contacts; }), ModelError);
}

/// Slope of a mass in a ring by one of its numbers.
SystemSlope slope_by(const MassInRing& p, double MassInRing::*member, double size = 0.0) {
  const Scene scene = p.scene();
  return slope_of("member", scene, p.*member, size, [&](double value) {
    MassInRing q = p;
    q.*member = value;
    return q.model();
  });
}

const auto stiffness = [](const ContactSystem& s) -> Mat { return s.K(); };
const auto clearance = [](const ContactSystem& s) { return s.contacts()[0].clearance; };
const auto rim_speed = [](const ContactSystem& s) { return s.contacts()[0].rim_speed; };
const auto load = [](const ContactSystem& s) -> Vec { return s.synchronous_load().cosine; };

// K / m, U Omega^2 / m, Omega R: derivatives by hand.
TEST(NumberSlopes, AreDerivatives) {
  const MassInRing p{.Omega = 80.0, .m = 2.0, .k = 3e4, .U = 1e-3, .mu = 0.1, .R = 0.02};
  {
    const SystemSlope beside = slope_by(p, &MassInRing::k);
    const NumberSlopes by(beside);
    EXPECT_LT((by.of(stiffness) - Mat::Identity(2, 2) / p.m).norm(), of_slopes / p.m);
    EXPECT_EQ(by.of(clearance), 0.0);
    EXPECT_EQ(by.of(load), Vec(Vec::Zero(2)));
  }
  {
    const SystemSlope beside = slope_by(p, &MassInRing::m);
    const NumberSlopes by(beside);
    const double slope = -p.k / (p.m * p.m);
    EXPECT_LT((by.of(stiffness) - slope * Mat::Identity(2, 2)).norm(), -of_slopes * slope);
  }
  {
    const SystemSlope beside = slope_by(p, &MassInRing::Omega);
    const NumberSlopes by(beside);
    EXPECT_NEAR(by.of(rim_speed), p.R, of_slopes * p.R);
    EXPECT_NEAR(by.of(load)(0), 2.0 * p.Omega * p.U / p.m, of_slopes * p.Omega * p.U);
  }
  {
    const SystemSlope beside = slope_by(p, &MassInRing::clearance);
    const NumberSlopes by(beside);
    EXPECT_NEAR(by.of(clearance), 1.0, of_slopes);
    EXPECT_EQ(by.of(stiffness), Mat(Mat::Zero(2, 2)));
  }
}

// Along several parameters at once.
TEST(NumberSlopes, AreSumsOfSlopesByTheirWeights) {
  const MassInRing p{.Omega = 80.0, .m = 2.0, .k = 3e4, .R = 0.02};
  const std::vector<SystemSlope> slopes{slope_by(p, &MassInRing::k),
                                        slope_by(p, &MassInRing::Omega)};
  const NumberSlopes by(slopes, Vec{{5.0, -0.25}});
  EXPECT_LT((by.of(stiffness) - 5.0 / p.m * Mat::Identity(2, 2)).norm(), of_slopes * 5.0);
  EXPECT_NEAR(by.of(rim_speed), -0.25 * p.R, of_slopes * p.R);
}

TEST(NumberSlopes, AreNoneWhereMotionsChangeTheirKind) {
  const auto require = [](const MassInRing& p, double MassInRing::*member, double size) {
    require_smooth(p.scene().contacts, slope_by(p, member, size));
  };
  const MassInRing rubbing{.mu = 0.1, .R = 0.01}, smooth{.mu = 0.0, .R = 0.01},
      standing{.Omega = 0.0};
  EXPECT_NO_THROW(require(rubbing, &MassInRing::mu, 0.0));
  EXPECT_NO_THROW(require(rubbing, &MassInRing::Omega, 0.0));
  EXPECT_THROW(require(smooth, &MassInRing::mu, 0.1), NumericalError);
  EXPECT_THROW(require(standing, &MassInRing::Omega, 1.0), NumericalError);
}

// A model in the shapes of its own scene is that scene, though these are few.
TEST(SystemSlope, HoldsTheShapesOfItsScene) {
  constexpr double of_reduction = 1e-7;  // of the largest entry: products in another order
  test::TwoDiskRub rotor{};
  const Scene scene = rotor.scene();
  const auto is_near = [&](const Mat& a, const Mat& b) {
    return (a - b).cwiseAbs().maxCoeff() <= of_reduction * b.cwiseAbs().maxCoeff();
  };
  const ContactSystem same = in_shapes_of(scene, rotor.model());
  EXPECT_TRUE(is_near(same.K(), scene.contacts.K()));
  EXPECT_TRUE(is_near(same.D(), scene.contacts.D()));
  EXPECT_TRUE(is_near(same.contacts()[0].U, scene.contacts.contacts()[0].U));
  // with other bearings the shapes stay, K changes
  rotor.k *= 1.1;
  const ContactSystem other = in_shapes_of(scene, rotor.model());
  EXPECT_EQ(Mat(other.contacts()[0].U), Mat(same.contacts()[0].U));
  EXPECT_FALSE(is_near(other.K(), same.K()));
}

// Where only contacts and loads differ, nothing is assembled: K and D are those of the scene to the
// last bit, and the rest is what assembling makes of it.
TEST(SystemSlope, TakesTheRotorOfItsSceneOver) {
  test::TwoDiskRub rotor{};
  const Scene scene = rotor.scene();
  Model model = rotor.model();
  model.contacts[0].friction.mu += 0.1;
  model.structure.unbalances[0].moment *= 2.0;
  const ContactSystem found = in_shapes_of(scene, model);
  EXPECT_EQ(found.K(), scene.contacts.K());
  EXPECT_EQ(found.D(), scene.contacts.D());
  const ContactSystem assembled = scene_in_shapes_of(scene, model).contacts;
  EXPECT_EQ(found.contacts()[0].friction.mu, model.contacts[0].friction.mu);
  EXPECT_EQ(Mat(found.contacts()[0].U), Mat(assembled.contacts()[0].U));
  EXPECT_EQ(found.synchronous_load().cosine, assembled.synchronous_load().cosine);
  model.speed *= 1.1;
  EXPECT_EQ(in_shapes_of(scene, model).phase_rate(), model.speed);
}

TEST(SystemSlope, RefusesAnotherNumberOfFreedoms) {
  const Scene scene = MassInRing{}.scene();
  EXPECT_THROW(in_shapes_of(scene, RotorStator{}.model()), NumericalError);
}

}  // namespace whirl::system_slope_test
