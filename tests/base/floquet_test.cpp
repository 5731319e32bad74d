// Multipliers of products of matrices, against known ones.

#include "libbase/numerics/floquet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace whirl::floquet_test {

// A = B_m ... B_1 with B_i = Q_(i+1) diag(1000, -0.5, 0.001) Q_i^T: multipliers 1000^m, (-0.5)^m
// and 0.001^m, which stand 36 decades apart for m = 6. The product itself would keep the first
// only.
TEST(FloquetMultipliers, SmallMultipliersDoNotDrownInLargeOnes) {
  const auto rotation = [](int i) {
    const double a = 0.7 * (i % 6), b = 0.4 * (i % 6);
    Mat one(3, 3), other(3, 3);
    one << std::cos(a), -std::sin(a), 0.0, std::sin(a), std::cos(a), 0.0, 0.0, 0.0, 1.0;
    other << 1.0, 0.0, 0.0, 0.0, std::cos(b), -std::sin(b), 0.0, std::sin(b), std::cos(b);
    return Mat(one * other);
  };
  const Vec d = (Vec(3) << 1e3, -0.5, 1e-3).finished();
  for (const int m : {1, 2, 5, 6}) {
    std::vector<Mat> segments;
    for (int i = 0; i < m; ++i) {
      const Mat next = m == 1 ? rotation(0) : rotation((i + 1) % m);
      segments.push_back(next * d.asDiagonal() * rotation(i).transpose());
    }
    const CVec found = multipliers_of(segments);
    for (int k = 0; k < 3; ++k) {
      const double exact = std::pow(d(k), m);
      // errors of the m-th root, eps * 1000, count m-fold and by its size
      const double allowed = 1e-13 * m * 1e3 / std::abs(d(k)) * 10.0;
      EXPECT_NEAR(found(k).real() / exact, 1.0, allowed) << m << " " << k;
      EXPECT_EQ(found(k).imag(), 0.0);
    }
  }
}

// Rotation by an angle about an axis that it stretches: the pair stays together, the one along the
// motion, 1, is left out.
TEST(FloquetMultipliers, AcrossAMotionLeaveOutTheOneAlongIt) {
  const double angle = 1.1, size = 0.7;
  Mat A = Mat::Zero(4, 4);
  A.topLeftCorner(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  A *= size;
  A(2, 2) = 1.0;
  A(3, 3) = -3.0;
  const CVec found = multipliers_across(A);
  ASSERT_EQ(found.size(), 3);
  EXPECT_NEAR(std::abs(found(0) + 3.0), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(found(1) - std::polar(size, angle)), 0.0, 1e-14);
  EXPECT_EQ(found(2), std::conj(found(1)));
}

}  // namespace whirl::floquet_test
