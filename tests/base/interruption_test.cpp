#include "libbase/system/interruption.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "libbase/numerics/sparse_lu.hpp"

namespace whirl {
namespace interruption_test {
namespace {

struct Left {};

Sparse one() {
  Sparse A(1, 1);
  A.insert(0, 0) = 2.0;
  return A;
}

TEST(Interruption, IsAskedOfInItsThreadWhileItLives) {
  int asked = 0;
  interruption_point();
  {
    const Interruptible outer([&] { asked += 1; });
    interruption_point();
    {
      const Interruptible inner([&] { asked += 10; });
      interruption_point();
      std::thread([] { interruption_point(); }).join();
    }
    interruption_point();
  }
  interruption_point();
  EXPECT_EQ(asked, 12);
}

TEST(Interruption, LeavesBeforeAMatrixIsFactored) {
  const Interruptible leaves([] { throw Left(); });
  EXPECT_THROW(SparseLu{one()}, Left);
  const CSparse matrix = one().cast<Complex>();
  ComplexSparseLu lu(matrix);
  EXPECT_THROW(lu.factorize(matrix), Left);
}

}  // namespace
}  // namespace interruption_test
}  // namespace whirl
