#include "libdyn/studies/exponents.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace whirl::inline dyn {

namespace {

constexpr Eigen::Index most_batches = 16;
constexpr double bounded = 2.0;  ///< times what an exponent of zero comes out as
constexpr double chance = 2.5;   ///< standard errors; see docs/validation.md for both

/// Growth of a tangent in the revolutions from one to before another.
double growth(const Mat& growths, Eigen::Index tangent, Eigen::Index from, Eigen::Index to) {
  return growths(tangent, to - 1) - (from > 0 ? growths(tangent, from - 1) : 0.0);
}

/// Standard error of a mean growth per revolution, from the means of batches.
double standard_error(const Mat& growths, Eigen::Index tangent, Eigen::Index first) {
  const Eigen::Index used = growths.cols() - first, batches = std::min(most_batches, used);
  if (batches < 2) return 0.0;
  Vec means(batches);
  for (Eigen::Index b = 0; b < batches; ++b) {
    const Eigen::Index from = first + used * b / batches, to = first + used * (b + 1) / batches;
    means(b) = growth(growths, tangent, from, to) / static_cast<double>(to - from);
  }
  const auto count = static_cast<double>(batches);
  return std::sqrt((means.array() - means.mean()).square().sum() / (count * (count - 1.0)));
}

}  // namespace

ExponentEstimate estimate_exponents(const Mat& growths) {
  const Eigen::Index revolutions = growths.cols(), first = revolutions / 4;
  const auto T = static_cast<double>(revolutions);
  ExponentEstimate estimate{.exponents = Vec(growths.rows()), .zero = (1.0 + std::log(T)) / T};
  for (Eigen::Index i = 0; i < growths.rows(); ++i) {
    estimate.exponents(i) =
        growth(growths, i, first, revolutions) / static_cast<double>(revolutions - first);
  }
  Eigen::Index largest = 0;
  estimate.exponents.maxCoeff(&largest);
  estimate.resolution = bounded * estimate.zero + chance * standard_error(growths, largest, first);
  std::sort(estimate.exponents.begin(), estimate.exponents.end(), std::greater<>());
  return estimate;
}

ExponentPath exponent_path(const Mat& growths, Eigen::Index most) {
  const Eigen::Index estimates = std::min(most, growths.cols());
  ExponentPath path{.exponents = Mat(growths.rows(), estimates)};
  for (Eigen::Index i = 0; i < estimates; ++i) {
    const Eigen::Index revolutions = growths.cols() * (i + 1) / estimates;
    path.revolutions.push_back(static_cast<double>(revolutions));
    path.exponents.col(i) = estimate_exponents(growths.leftCols(revolutions)).exponents;
  }
  return path;
}

}  // namespace whirl::inline dyn
