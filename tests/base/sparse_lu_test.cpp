// Sparse factors: that an old order of pivots serves only while it is stable.

#include "libbase/numerics/sparse_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::sparse_lu_test {

constexpr double rounding = 1e-14;

Sparse matrix(double a, double b, double c, double d) {
  Sparse A(2, 2);
  A.insert(0, 0) = a, A.insert(0, 1) = b, A.insert(1, 0) = c, A.insert(1, 1) = d;
  A.makeCompressed();
  return A;
}

TEST(SparseLu, SolvesForSeveralColumns) {
  const SparseLu lu(matrix(4.0, 1.0, 2.0, 3.0));
  ASSERT_TRUE(lu.is_regular());
  const Mat x = lu.solve(Mat::Identity(2, 2));
  EXPECT_LT((x - (Mat(2, 2) << 0.3, -0.1, -0.2, 0.4).finished()).norm(), rounding);
}

TEST(SparseLu, OfASingularMatrixIsNotRegular) {
  EXPECT_FALSE(SparseLu(matrix(0.0, 0.0, 0.0, 3.0)).is_regular());
  EXPECT_FALSE(SparseLu(matrix(1.0, 2.0, 2.0, 4.0)).is_regular());
  EXPECT_FALSE(SparseLu{}.is_regular());
}

TEST(SparseLu, OfAMatrixThatIsNotFiniteIsNotRegular) {
  for (const double x : {std::nan(""), HUGE_VAL}) {
    EXPECT_FALSE(SparseLu(matrix(x, 1.0, 1.0, 3.0)).is_regular()) << x;
    const CSparse regular = matrix(2.0, 1.0, 1.0, 3.0).cast<Complex>();
    const CSparse other = matrix(x, 1.0, 1.0, 3.0).cast<Complex>();
    ComplexSparseLu lu(regular);
    EXPECT_FALSE(lu.factorize(other)) << x;
    EXPECT_TRUE(lu.factorize(regular));
    EXPECT_FALSE(lu.factorize(other)) << x;
  }
}

// The pivots of the first matrix, on its diagonal, lose all digits of the second.
TEST(ComplexSparseLu, TakesOtherPivotsWhereThoseOfTheLastMatrixAreUnstable) {
  const CSparse first = matrix(2.0, 1.0, 1.0, 2.0).cast<Complex>();
  const CSparse second = matrix(1e-20, 1.0, 1.0, 1.0).cast<Complex>();
  ComplexSparseLu lu(first);
  ASSERT_TRUE(lu.factorize(first));
  ASSERT_TRUE(lu.factorize(second));
  const CVec b = (CVec(2) << Complex(1.0), Complex(0.0, 2.0)).finished();
  const CVec x = lu.solve(b);
  EXPECT_LT((second * x - b).norm(), rounding);
}

// Each freedom for itself: their rows are blocks of their own.
TEST(ComplexSparseLu, TellsAZeroOnTheDiagonalAfterARegularMatrix) {
  const auto diagonal = [](double a, double d) {
    Sparse A(2, 2);
    A.insert(0, 0) = a, A.insert(1, 1) = d;
    A.makeCompressed();
    return CSparse(A.cast<Complex>());
  };
  ComplexSparseLu lu(diagonal(1.0, 1.0));
  const CSparse regular = diagonal(1.0, 2.0), singular = diagonal(1.0, 0.0);
  const CSparse other = diagonal(3.0, 2.0);
  EXPECT_TRUE(lu.factorize(regular));
  EXPECT_FALSE(lu.factorize(singular));
  EXPECT_TRUE(lu.factorize(other));
  EXPECT_LT(std::abs(lu.solve(CVec::Ones(2))(0) - 1.0 / 3.0), rounding);
}

}  // namespace whirl::sparse_lu_test
