#include "libdyn/studies/settling.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/smooth_average.hpp"

namespace whirl::inline dyn {

Drift drift_of(const Mat& points) {
  constexpr double repeats = 1e-9;    // spread of sections that are the same
  constexpr double vanishing = 0.01;  // of a mean square, that counts as going to zero
  const Eigen::Index count = points.cols(), half = count / 2, quarter = count / 4;
  if (quarter < 2) return {};
  const Vec mean = points.rowwise().mean();
  const double spread = std::sqrt((points.colwise() - mean).rowwise().squaredNorm().maxCoeff() /
                                  static_cast<double>(count));
  if (!(spread > repeats)) return {};
  Mat observed(2 * points.rows(), count);
  observed.topRows(points.rows()) = (points.colwise() - mean) / spread;
  observed.bottomRows(points.rows()) = observed.topRows(points.rows()).cwiseAbs2();

  const Vec weights = smooth_weights(half);
  const Vec a_1 = observed.leftCols(half) * weights;
  const Vec a_2 = observed.middleCols(quarter, half) * weights;
  const Vec a_3 = observed.middleCols(count - half, half) * weights;
  Eigen::Index most = 0;
  Drift drift{.change = (a_3 - a_1).cwiseAbs().maxCoeff(&most)};
  const double before = a_2(most) - a_1(most), after = a_3(most) - a_2(most);
  const double ratio = after / before;
  if (!(ratio > 0.0 && ratio < 1.0)) return drift;
  drift.rate = -std::log(ratio) / static_cast<double>(quarter);
  // from the middle of the last half to its end
  const double limit = a_3(most) + after * ratio / (1.0 - ratio);
  drift.left =
      std::abs(limit - a_3(most)) * std::exp(-0.5 * drift.rate * static_cast<double>(half));
  if (most >= points.rows() && std::abs(limit) < vanishing * a_1(most)) {  // it ends in a point
    drift.rate *= 0.5;
    drift.left = std::sqrt(drift.left);
  }
  drift.spread = spread;
  return drift;
}

}  // namespace whirl::inline dyn
