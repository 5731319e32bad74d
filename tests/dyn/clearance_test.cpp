// How much of its clearances a rotor takes: at rest, in a motion, and along the speeds of its
// response to unbalance, all in closed form.

#include "libdyn/system/clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::clearance_test {

using test::MassInRing;

constexpr double rounding = 1e-12;  ///< relative
constexpr double of_roots = 1e-8;   ///< relative: ends of ranges are roots to 1e-9

/// A mass with a ring, a flat stop, a bearing and a film, each with a clearance of its own.
Model many() {
  Model m = MassInRing{.clearance = 1e-3, .offset = {2e-4, 0.0}}.model();
  m.contacts.push_back(m.contacts[0]);
  m.contacts[1].name = "stop";
  m.contacts[1].offset = Vec2::Zero();
  m.contacts[1].clearance = 5e-4;
  m.contacts[1].geometry = geometry::Stop{.angle = 0.5 * test::pi};  // met along +y
  m.structure.bearings[0].name = "left";
  m.structure.bearings[0].clearance = 6e-4;
  m.films = test::MassOnFilm{.offset = {0.0, 1e-4}}.model().films;
  m.films[0].at = test::body("mass");
  m.films[0].bearing.clearance = 8e-4;
  return m;
}

/// A full vector that displaces the mass.
Vec displaced(const Assembler& assembler, const Vec2& by) {
  const DofMap& dofs = assembler.dofs();
  const Point at = assembler.point(test::body("mass"));
  Vec full = Vec::Zero(dofs.full_size);
  for (const int i : {0, 1}) full(dofs.full_index(at, i)) = by(i);
  return full;
}

const RunningClearance* named_one(const std::vector<RunningClearance>& all,
                                  const std::string& name) {
  for (const RunningClearance& one : all) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

TEST(Clearances, AreLeftWhereARotorRests) {
  const Model m = many();
  const Assembler assembler(m.structure);
  const Vec2 u(1e-4, -3e-4);
  const auto all = running_clearances(m, assembler, displaced(assembler, u));
  ASSERT_EQ(all.size(), 4u);
  const struct {
    const char* name;
    double clearance, distance;
  } expected[] = {{"contact ring", 1e-3, std::hypot(1e-4, 3e-4)},  // of (1e-4 - 2e-4, -3e-4)
                  {"contact stop", 5e-4, -3e-4},                   // away from it
                  {"bearing left", 6e-4, std::hypot(1e-4, 3e-4)},
                  {"oil film film", 8e-4, std::hypot(1e-4, 4e-4)}};
  for (const auto& [name, clearance, distance] : expected) {
    const RunningClearance* one = named_one(all, name);
    ASSERT_TRUE(one) << name;
    EXPECT_EQ(one->clearance, clearance) << name;
    EXPECT_NEAR(one->distance, distance, rounding * clearance) << name;
    EXPECT_NEAR(one->left(), clearance - distance, rounding * clearance) << name;
  }
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LE(all[i - 1].left(), all[i].left());
  EXPECT_EQ(all[0].name, "bearing left");
}

// A bearing that tells no clearance has none.
TEST(Clearances, AreOnlyThoseThatAreTold) {
  Model m = many();
  m.structure.bearings[0].clearance = 0.0;
  const Assembler assembler(m.structure);
  const auto all = running_clearances(m, assembler, displaced(assembler, Vec2::Zero()));
  EXPECT_EQ(all.size(), 3u);
  EXPECT_FALSE(named_one(all, "bearing left"));
}

// Of three instants each clearance has its own: the ring the farthest from its middle, the stop the
// highest.
TEST(Clearances, AreTakenMostAtOneInstantOfAMotion) {
  const Model m = many();
  const Assembler assembler(m.structure);
  Mat basis(assembler.dofs().full_size, 2);
  basis << displaced(assembler, {1.0, 0.0}), displaced(assembler, {0.0, 1.0});
  Mat coordinates(2, 3);
  coordinates << -5e-4, 2e-4, 1e-4,  //
      0.0, 3e-4, -4e-4;
  const auto all = largest_distances(m, assembler, basis, coordinates);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].name, "contact ring");  // in the order of the model
  EXPECT_NEAR(all[0].distance, 7e-4, rounding * 1e-3);
  EXPECT_EQ(all[1].name, "contact stop");
  EXPECT_NEAR(all[1].distance, 3e-4, rounding * 1e-3);
  const RunningClearance* bearing = named_one(all, "bearing left");
  ASSERT_TRUE(bearing);
  EXPECT_NEAR(bearing->distance, 5e-4, rounding * 1e-3);
  const RunningClearance* film = named_one(all, "oil film film");
  ASSERT_TRUE(film);
  EXPECT_NEAR(film->distance, std::hypot(5e-4, 1e-4), rounding * 1e-3);
}

/// A mass out of balance that moves on a circle of radius U Omega^2 / |k - m Omega^2 + i c Omega|.
struct Circle {
  MassInRing p{.k = 1e4, .c = 20.0, .U = 4e-4, .clearance = 1e-3};

  double radius(double Omega) const {
    return p.U * Omega * Omega / std::hypot(p.k - p.m * Omega * Omega, p.c * Omega);
  }
  /// Speeds at which that is the clearance C: (U^2 - C^2 m^2) z^2 + C^2 (2 k m - c^2) z = C^2 k^2
  /// of z = Omega^2.
  SpeedRange beyond() const {
    const double C2 = p.clearance * p.clearance, a = C2 * p.m * p.m - p.U * p.U,
                 b = 0.5 * C2 * (2.0 * p.k * p.m - p.c * p.c),
                 root = std::sqrt(b * b - a * C2 * p.k * p.k);
    return {std::sqrt((b - root) / a), std::sqrt((b + root) / a)};
  }
  ClearanceUse use(const std::vector<double>& speeds) const {
    const Model m = p.model();
    const auto uses = clearance_uses(m, Assembler(m.structure), speeds);
    EXPECT_EQ(uses.size(), 1u);
    return uses.at(0);
  }
};

std::vector<double> speeds_between(double first, double last) {
  std::vector<double> all;
  for (int i = 0; i <= 40; ++i) all.push_back(first + (last - first) * i / 40);
  return all;
}

TEST(Clearances, AreExceededBetweenTheRootsOfTheResponse) {
  const Circle circle;
  const auto speeds = speeds_between(20.0, 220.0);
  const ClearanceUse use = circle.use(speeds);
  const SpeedRange expected = circle.beyond();
  EXPECT_EQ(use.name, "contact ring");
  EXPECT_EQ(use.clearance, 1e-3);
  ASSERT_EQ(use.beyond.size(), 1u);
  EXPECT_NEAR(use.beyond[0].first, expected.first, of_roots * expected.first);
  EXPECT_NEAR(use.beyond[0].last, expected.last, of_roots * expected.last);
  double largest = 0.0, at = 0.0;
  for (const double Omega : speeds) {
    if (circle.radius(Omega) > largest) largest = circle.radius(Omega), at = Omega;
  }
  EXPECT_NEAR(use.largest, largest, 1e-9 * largest);
  EXPECT_EQ(use.at, at);
}

// A range that begins or ends outside the speeds begins or ends with them.
TEST(Clearances, AreExceededUpToTheEndsOfTheSpeeds) {
  const Circle circle;
  const SpeedRange expected = circle.beyond();
  const ClearanceUse rising = circle.use(speeds_between(20.0, 100.0));
  ASSERT_EQ(rising.beyond.size(), 1u);
  EXPECT_NEAR(rising.beyond[0].first, expected.first, of_roots * expected.first);
  EXPECT_EQ(rising.beyond[0].last, 100.0);
  const ClearanceUse falling = circle.use(speeds_between(100.0, 220.0));
  ASSERT_EQ(falling.beyond.size(), 1u);
  EXPECT_EQ(falling.beyond[0].first, 100.0);
  EXPECT_NEAR(falling.beyond[0].last, expected.last, of_roots * expected.last);
  EXPECT_TRUE(circle.use(speeds_between(20.0, 60.0)).beyond.empty());
}

// About another center the farthest place of a circle is its radius and the offset away.
TEST(Clearances, CountFromTheMiddleOfTheClearance) {
  constexpr double of_moments = 2e-5;  // of 720 moments of a period
  Circle circle;
  circle.p.offset = {3e-4, -4e-4};
  const ClearanceUse use = circle.use({50.0});
  EXPECT_NEAR(use.largest, circle.radius(50.0) + 5e-4, of_moments * use.largest);
}

}  // namespace whirl::clearance_test
