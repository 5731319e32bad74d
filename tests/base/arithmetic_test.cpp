// The mathematical library by its values.

#include "libbase/system/arithmetic.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <thread>

namespace whirl::arithmetic_test {

TEST(Mathematics, IsNamedByItsVersionAndItsValues) {
  EXPECT_TRUE(std::regex_match(mathematics(), std::regex("(glibc [0-9.]+|libm) [0-9a-f]{8}")))
      << mathematics();
  std::string again;
  std::thread([&] { again = mathematics(); }).join();
  EXPECT_EQ(again, mathematics());
}

}  // namespace whirl::arithmetic_test
