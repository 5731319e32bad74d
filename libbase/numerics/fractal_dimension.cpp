#include "libbase/numerics/fractal_dimension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace whirl::inline base {

double fractal_dimension(const Mat& points) {
  constexpr std::ptrdiff_t near = 8, far = 32;
  const Eigen::Index count = points.cols();
  if (count < 3 * far) return std::numeric_limits<double>::quiet_NaN();
  const double extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).cwiseAbs().maxCoeff();
  const double same = 1e-16 * extent * extent;  // square of a distance that is none
  double sum = 0.0;
  int terms = 0;
  std::vector<double> squares(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      squares[static_cast<std::size_t>(j)] = (points.col(j) - points.col(i)).squaredNorm();
    }
    // the point itself comes first
    std::nth_element(squares.begin(), squares.begin() + far, squares.end());
    std::nth_element(squares.begin(), squares.begin() + near, squares.begin() + far);
    if (squares[near] <= same) continue;  // it repeats
    sum += 0.5 * std::log(squares[far] / squares[near]);
    ++terms;
  }
  return 2 * terms < count ? 0.0 : terms * std::log(double{far} / double{near}) / sum;
}

}  // namespace whirl::inline base
