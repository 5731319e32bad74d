// Codes of kinds of motion: files hold them, so they stay what they are.

#include "libio/results/motion_codes.hpp"

#include <gtest/gtest.h>

namespace whirl::motion_codes_test {

// The numbers that were in files before there were words in them; new ones come last.
TEST(MotionWords, AreThoseOfTheList) {
  EXPECT_EQ(
      code_legend<MotionKind>(),
      "0 equilibrium, 1 periodic, 2 quasi-periodic, 3 chaotic, 4 hyperchaotic, 5 not settled");
  EXPECT_EQ(code_words<MotionKind>(),
            "equilibrium,periodic,quasi-periodic,chaotic,hyperchaotic,not settled");
}

}  // namespace whirl::motion_codes_test
