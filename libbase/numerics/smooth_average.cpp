#include "libbase/numerics/smooth_average.hpp"

#include <cmath>

namespace whirl::inline base {

Vec smooth_weights(Eigen::Index count) {
  Vec w(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = (static_cast<double>(i) + 1.0) / (static_cast<double>(count) + 1.0);
    w(i) = std::exp(-1.0 / (t * (1.0 - t)));
  }
  return w / w.sum();
}

}  // namespace whirl::inline base
