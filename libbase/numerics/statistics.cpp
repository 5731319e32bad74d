#include "libbase/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline base {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double standard_deviation(const Vec& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

}  // namespace whirl::inline base
