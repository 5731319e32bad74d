// Where a command line has speeds without a unit.

#include <gtest/gtest.h>

#include "libio/text/bare_speed.hpp"

namespace whirl::bare_speeds_test {

TEST(BareSpeeds, AreLookedForWhereverSpeedsAre) {
  std::string options;
  for (const BareSpeed& s : bare_speeds({.speed = "3000",
                            .sets = {"operation.speed=300", "contact.ring.friction=0.1"},
                            .speeds = "0:8000:50",
                            .over = {"operation.speed=130:140"},
                            .at = "135"})) {
    options += s.option + s.value + "; ";
  }
  EXPECT_EQ(options,
            "--speed3000; --set operation.speed=300; --speeds0:8000:50; --over "
            "operation.speed=130:140; --at135; ");
}

TEST(BareSpeeds, TakeTheUnitOfTheRangeTheyAreWithin) {
  EXPECT_TRUE(bare_speeds({.over = {"operation.speed=130:140rad/s"}, .at = "135"}).empty());
  EXPECT_TRUE(bare_speeds({.speed = "3000rpm", .speeds = "0", .at = "135"}).empty());
}

}  // namespace whirl::bare_speeds_test
