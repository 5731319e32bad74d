// Modes followed from speed to speed are those that are found when all are computed at each.

#include "libfe/analyses/followed_modes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/rotors.hpp"

namespace whirl::followed_modes_test {

using test::at;
using test::rpm;

constexpr double equal = 1e-8;  // relative; what is computed alone is refined to 1e-11

std::vector<double> speeds(int count, double last) {
  std::vector<double> all;
  for (int i = 1; i <= count; ++i) all.push_back(i * last / count);
  return all;
}

std::vector<double> every_sixth(const std::vector<double>& all) {
  std::vector<double> some;
  for (std::size_t i = 2; i < all.size(); i += 6) some.push_back(all[i]);
  return some;
}

/// At each of these speeds the same modes come out, in the same order.
void expect_all(const Structure& structure, const std::vector<double>& over,
                const std::vector<double>& asked, int count) {
  const Assembler assembler(structure);
  const ModeFinder finder(assembler);
  FollowedModes modes(assembler, finder, over, count);
  for (const double Omega : asked) {
    const std::vector<Mode> all = finder.at(Omega, count).oscillatory, &found = modes.at(Omega);
    ASSERT_EQ(found.size(), all.size()) << Omega;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_LT(std::abs(found[i].lambda - all[i].lambda), equal * std::abs(all[i].lambda))
          << Omega << " mode " << i + 1;
      EXPECT_EQ(found[i].whirl, all[i].whirl) << Omega << " mode " << i + 1;
    }
  }
}

/// Isotropic bearings: forward and backward branches cross; heavy damping: modes of bearings do.
TEST(FollowedModes, AreThoseOfEverySpeed) {
  for (const double damping : {300.0, 3e5}) {
    for (const bool is_isotropic : {true, false}) {
      SCOPED_TRACE(std::to_string(damping) + (is_isotropic ? " isotropic" : " orthotropic"));
      const auto bearing = is_isotropic ? test::isotropic(5e6, damping)
                                        : test::orthotropic(1e6, 2e7, damping, 2.0 * damping);
      const auto over = speeds(40, 12000 * rpm);
      expect_all(test::two_disk(bearing, 8), over, every_sixth(over), 10);
    }
  }
}

/// Coefficients by a table, whose knots bend the branches.
TEST(FollowedModes, PassTheKnotsOfTables) {
  const TableBearing table{
      {.speed = {0.0, 500.0, 900.0},
       .rows = {test::isotropic(1e6, 100.0), test::orthotropic(3e6, 2e7, 900.0),
                test::isotropic(2e7, 5e4)}}};
  Structure s = test::two_disk(test::orthotropic(1e6, 2e6, 300.0, 400.0), 8);
  s.bearings[1] = test::bearing(at(1.5), AnyBearing(table));
  const auto over = speeds(30, 1200.0);
  expect_all(s, over, every_sixth(over), 10);
}

/// Few speeds, between which shapes change beyond recognition.
TEST(FollowedModes, TakeLongStepsByHalves) {
  const Structure s = test::two_disk(test::orthotropic(1e6, 2e6, 300.0, 400.0), 8);
  expect_all(s, speeds(3, 60000 * rpm), speeds(3, 60000 * rpm), 10);
}

/// Speeds that nobody told before: between two known ones, beyond all, and at rest.
TEST(FollowedModes, AreFoundAtOtherSpeeds) {
  const Structure s = test::two_disk(test::orthotropic(1e6, 2e6, 300.0, 400.0), 8);
  expect_all(s, speeds(20, 900.0), {17.0, 333.3, 444.999, 899.0, 950.0, 0.0}, 8);
}

}  // namespace whirl::followed_modes_test
