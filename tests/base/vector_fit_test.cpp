#include "libbase/numerics/vector_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "libbase/error.hpp"

namespace whirl::vector_fit_test {

constexpr Complex i{0.0, 1.0};

/// kb - kb^2 / (m s^2 + c s + kp + kb), a pedestal under a bearing.
Complex pedestal(Complex s) {
  return 1e6 - 1e12 / (4.0 * s * s + 500.0 * s + 5e6);
}

CMat samples(const Vec& omega, const auto& function) {
  CMat H(1, omega.size());
  for (Eigen::Index k = 0; k < omega.size(); ++k) H(0, k) = function(i * omega(k));
  return H;
}

// acceptance: 200 samples of the pedestal give its pole and residue
TEST(VectorFit, FindsThePoleOfAPedestal) {
  const Vec omega = Vec::LinSpaced(200, 10.0, 3000.0);
  const RationalFit fit = vector_fit(omega, samples(omega, pedestal), 2, 1);
  ASSERT_EQ(fit.poles.size(), 1);
  const Complex pole{-62.5, std::sqrt(1.25e6 - 62.5 * 62.5)};
  const Complex residue{0.0, 1.25e11 / pole.imag()};
  EXPECT_LT(std::abs(fit.poles(0) - pole), 1e-8 * std::abs(pole));
  EXPECT_LT(std::abs(fit.residues(0, 0) - residue), 1e-8 * std::abs(residue));
  EXPECT_NEAR(fit.direct(0, 0), 1e6, 1e-2);
  EXPECT_LT(fit.largest, 1e-10);
}

TEST(VectorFit, FindsManyPolesOfManyEntries) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Vec omega = Vec::LinSpaced(300, 1.0, 400.0);
  const CVec poles = (CVec(4) << Complex(-1.0, 50.0), Complex(-0.3, 130.0), Complex(-8.0, 260.0),
                      Complex(-90.0, 0.0))
                         .finished();
  CMat H = CMat::Zero(3, omega.size());
  for (Eigen::Index e = 0; e < 3; ++e) {
    const double d = normal(random), m = 1e-3 * normal(random);
    for (const Complex p : poles) {
      const bool is_real = p.imag() == 0.0;
      const Complex r(1e2 * normal(random), is_real ? 0.0 : 1e2 * normal(random));
      for (Eigen::Index k = 0; k < omega.size(); ++k) {
        const Complex s = i * omega(k);
        H(e, k) += r / (s - p) + (is_real ? 0.0 : std::conj(r) / (s - std::conj(p)));
      }
    }
    for (Eigen::Index k = 0; k < omega.size(); ++k) H(e, k) += d - m * omega(k) * omega(k);
  }
  const RationalFit fit = vector_fit(omega, H, 7, 3);
  EXPECT_LT(fit.largest, 1e-9);
  ASSERT_EQ(fit.poles.size(), 4);
  for (const Complex p : poles) {
    EXPECT_LT((fit.poles.array() - p).abs().minCoeff(), 1e-7 * std::abs(p));
  }
}

TEST(VectorFit, IsStableUnderNoise) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const Vec omega = Vec::LinSpaced(200, 10.0, 3000.0);
  CMat H = samples(omega, pedestal);
  for (Eigen::Index k = 0; k < H.cols(); ++k) {
    H(0, k) *= 1.0 + 0.01 * Complex(normal(random), normal(random));
  }
  for (const int order : {2, 6, 11}) {
    const RationalFit fit = vector_fit(omega, H, order, 1);
    EXPECT_LE(fit.poles.real().maxCoeff(), 0.0) << order;
    EXPECT_LT(fit.error, 0.02) << order;
  }
}

TEST(VectorFit, RefusesWhatSaysNothing) {
  const Vec few = Vec::LinSpaced(3, 1.0, 3.0);
  EXPECT_THROW(vector_fit(few, CMat::Ones(1, 3), 4, 1), NumericalError);
  EXPECT_THROW(vector_fit(few, CMat::Zero(1, 3), 1, 1), NumericalError);
  EXPECT_THROW(vector_fit(few, CMat::Constant(1, 3, std::nan("")), 1, 1), NumericalError);
}

}  // namespace whirl::vector_fit_test
