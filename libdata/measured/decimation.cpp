#include "libdata/measured/decimation.hpp"

#include <cmath>
#include <numbers>

namespace whirl::inline data {

Mat decimated(const Mat& samples, int factor) {
  constexpr double pi = std::numbers::pi;
  constexpr int reach = 10;  // of the filter, in new samples
  const Eigen::Index half = static_cast<Eigen::Index>(reach) * factor;
  Vec filter(2 * half + 1);
  for (Eigen::Index j = -half; j <= half; ++j) {
    const double x = static_cast<double>(j) / factor;
    const double sinc = j == 0 ? 1.0 : std::sin(pi * x) / (pi * x);
    filter(j + half) =
        sinc * 0.5 * (1.0 + std::cos(pi * static_cast<double>(j) / static_cast<double>(half + 1)));
  }
  filter /= filter.sum();
  const Eigen::Index count = (samples.rows() - 2 * half - 1) / factor + 1;
  Mat kept(count, samples.cols());
  for (Eigen::Index t = 0; t < count; ++t) {
    kept.row(t) = filter.transpose() * samples.middleRows(t * factor, 2 * half + 1);
  }
  return kept;
}

}  // namespace whirl::inline data
