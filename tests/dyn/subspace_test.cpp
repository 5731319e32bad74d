// Subspace identification where the answer is exact: covariances of a known system in closed form.

#include "libdata/measured/subspace.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "libdata/measured/decimation.hpp"
#include "tests/support/random_response.hpp"

namespace whirl::subspace_test {

constexpr double pi = std::numbers::pi;

/// Covariances of a chain under white noise on its modes, which are independent of each other:
///
///   R_k = sum over j of phi_j phi_j^T e^(-zeta w t)
///                       (cos w_d t + zeta / sqrt(1 - zeta^2) sin w_d t)
OutputProducts exact_covariances(const test::MassChain& chain, double zeta, double spacing,
                                 int lags) {
  OutputProducts products{{}, 1.0};
  for (int k = 0; k < lags; ++k) {
    Mat R = Mat::Zero(chain.M.rows(), chain.M.rows());
    for (Eigen::Index j = 0; j < chain.frequencies.size(); ++j) {
      const double w = chain.frequencies(j), root = std::sqrt(1.0 - zeta * zeta);
      const double t = k * spacing, angle = w * root * t;
      R += std::exp(-zeta * w * t) * (std::cos(angle) + zeta / root * std::sin(angle)) *
           chain.shapes.col(j) * chain.shapes.col(j).transpose();
    }
    products.sums.push_back(R);
  }
  return products;
}

// From exact covariances all modes come back exactly, at the order of the system; beyond it there
// are no directions left.
TEST(Subspace, FindsAllModesInExactCovariances) {
  constexpr double exact = 1e-7;  // digits that a SVD with singular values down to 1e-9 leaves
  const double zeta = 0.02, spacing = 0.05;
  const auto chain = test::mass_chain(5, 25.91, 1e4, zeta);
  const SubspaceModels models(exact_covariances(chain, zeta, spacing, 24), 12, 40);
  ASSERT_EQ(models.most_order(), 10);
  const std::vector<Pole> poles = models.poles(10, spacing);
  ASSERT_EQ(poles.size(), 5u);
  for (Eigen::Index j = 0; j < 5; ++j) {
    const Pole& pole = poles[static_cast<std::size_t>(j)];
    EXPECT_NEAR(std::abs(pole.lambda), chain.frequencies(j), exact * chain.frequencies(j));
    EXPECT_NEAR(pole.damping_ratio(), zeta, exact);
    EXPECT_NEAR(pole.log_decrement(), 2.0 * pi * zeta / std::sqrt(1.0 - zeta * zeta), 1e-5);
    EXPECT_NEAR(channel_mac(pole.shape, chain.shapes.col(j)), 1.0, exact);
  }
}

// One sensor sees all five modes, as none has a node there.
TEST(Subspace, FindsAllModesAtOneChannel) {
  const double zeta = 0.02, spacing = 0.05;
  const auto chain = test::mass_chain(5, 25.91, 1e4, zeta);
  OutputProducts products = exact_covariances(chain, zeta, spacing, 60);
  for (Mat& R : products.sums) R = R.topLeftCorner(1, 1).eval();
  const SubspaceModels models(products, 30, 10);
  const std::vector<Pole> poles = models.poles(10, spacing);
  ASSERT_EQ(poles.size(), 5u);
  for (Eigen::Index j = 0; j < 5; ++j) {
    EXPECT_NEAR(std::abs(poles[static_cast<std::size_t>(j)].lambda), chain.frequencies(j),
                1e-5 * chain.frequencies(j));
  }
}

TEST(Subspace, ProductsOfStretchesAddUp) {
  std::mt19937_64 random(3);
  const Mat x = test::normal_numbers(random, 500, 3);
  const OutputProducts all = output_products(x, 10, 0, 491);
  OutputProducts sum = output_products(x, 10, 0, 200);
  const OutputProducts second = output_products(x, 10, 200, 291);
  sum += second;
  for (std::size_t k = 0; k < 10; ++k) EXPECT_LT((sum.sums[k] - all.sums[k]).norm(), 1e-10);
  sum -= second;
  EXPECT_EQ(sum.count, 200.0);
  EXPECT_NEAR(all.sums[2](0, 1), x.col(0).segment(2, 491).dot(x.col(1).head(491)), 1e-10);
}

// Tones below 0.4 of the new sampling rate stay as they are, at their times; those above 0.6 go.
TEST(Decimation, KeepsLowTonesAndTakesHighOnes) {
  const double spacing = 0.001;
  const int factor = 10;
  Mat x(4000, 2);
  for (int t = 0; t < x.rows(); ++t) {
    x(t, 0) = std::sin(2.0 * pi * 39.0 * spacing * t + 0.3);
    x(t, 1) = std::sin(2.0 * pi * 61.0 * spacing * t);
  }
  const Mat kept = decimated(x, factor);
  ASSERT_EQ(kept.rows(), (4000 - 200 - 1) / 10 + 1);
  double low = 0.0;
  for (int t = 0; t < kept.rows(); ++t)
    low = std::max(low, std::abs(kept(t, 0) - x(10 * (t + 10), 0)));
  EXPECT_LT(low, 0.01);
  EXPECT_LT(kept.col(1).cwiseAbs().maxCoeff(), 0.01);
}

}  // namespace whirl::subspace_test
