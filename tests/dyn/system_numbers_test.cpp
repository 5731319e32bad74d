// The numbers that motions follow from: as many blocks for every system of one kind, changed where
// anything that matters changes, and polynomials of parameters where they can be.

#include "libdyn/system/system_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "libdyn/system/require_coordinates.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::system_numbers_test {

using test::MassInRing;

constexpr double rounding = 1e-12;  ///< relative

const MassInRing ring{.Omega = 80.0,
                      .m = 2.0,
                      .k = 3e4,
                      .c = 20.0,
                      .U = 1e-3,
                      .phase = 0.3,
                      .kC = 1e6,
                      .cC = 40.0,
                      .mu = 0.1,
                      .R = 0.02,
                      .gravity = 9.81,
                      .offset = {1e-4, 2e-4}};

std::vector<Vec> numbers(const MassInRing& p) {
  return numbers_of(p.scene().contacts);
}

/// How many blocks differ; they must be as many, and as long.
int changed(const std::vector<Vec>& a, const std::vector<Vec>& b) {
  int count = 0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    EXPECT_EQ(a[i].size(), b[i].size()) << i;
    if (a[i].size() == b[i].size() && a[i] != b[i]) ++count;
  }
  return count;
}

TEST(SystemNumbers, AreTheSameOfTheSameSystem) {
  EXPECT_EQ(changed(numbers(ring), numbers(ring)), 0);
  for (const Vec& block : numbers(ring)) EXPECT_TRUE(block.allFinite());
}

// Whatever a motion depends on is among them.
TEST(SystemNumbers, ChangeWithEverythingThatMatters) {
  using Set = std::function<void(MassInRing&)>;
  const Set all[] = {
      [](MassInRing& p) { p.Omega *= 1.1; },     [](MassInRing& p) { p.m *= 1.1; },
      [](MassInRing& p) { p.k *= 1.1; },         [](MassInRing& p) { p.c *= 1.1; },
      [](MassInRing& p) { p.U *= 1.1; },         [](MassInRing& p) { p.phase += 0.1; },
      [](MassInRing& p) { p.kC *= 1.1; },        [](MassInRing& p) { p.cC *= 1.1; },
      [](MassInRing& p) { p.mu *= 1.1; },        [](MassInRing& p) { p.R *= 1.1; },
      [](MassInRing& p) { p.clearance *= 1.1; }, [](MassInRing& p) { p.gravity *= 1.1; },
      [](MassInRing& p) { p.offset *= 1.1; }};
  int number = 0;
  for (const Set& set : all) {
    MassInRing other = ring;
    set(other);
    EXPECT_GT(changed(numbers(ring), numbers(other)), 0) << number;
    ++number;
  }
}

// A number that has a block of its own changes that alone.
TEST(SystemNumbers, StandInBlocksOfOneKind) {
  for (double MassInRing::*member : {&MassInRing::kC, &MassInRing::cC, &MassInRing::mu}) {
    MassInRing other = ring;
    other.*member *= 2.0;
    EXPECT_EQ(changed(numbers(ring), numbers(other)), 1);
  }
}

// Of a film the inverse of its clearance: along it, all numbers but the force's factor are
// polynomials of the first degree, as the mean of two at the ends shows.
TEST(SystemNumbers, ArePolynomialsOfAnInverseClearance) {
  const auto at = [](double inverse) {
    test::MassOnFilm p{};
    p.bearing.clearance = 1.0 / inverse;
    p.bearing.viscosity *= std::pow(1e-4 * inverse, -2);  // holds viscosity / clearance^2
    return numbers_of(p.scene().contacts);
  };
  const auto low = at(0.9e4), middle = at(1e4), high = at(1.1e4);
  ASSERT_EQ(low.size(), middle.size());
  ASSERT_EQ(high.size(), middle.size());
  int changed_blocks = 0;
  for (std::size_t i = 0; i < middle.size(); ++i) {
    EXPECT_LT((0.5 * (low[i] + high[i]) - middle[i]).norm(), rounding * (1.0 + middle[i].norm()))
        << i;
    if ((high[i] - low[i]).norm() > 1e-3 * middle[i].norm()) ++changed_blocks;
  }
  EXPECT_EQ(changed_blocks, 2);  // 1 / clearance, and that over the rate of the phase
}

TEST(RequireCoordinates, IsContentWithAnySystemThatMoves) {
  EXPECT_NO_THROW(require_coordinates(ring.scene().contacts));
}

}  // namespace whirl::system_numbers_test
