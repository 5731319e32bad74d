#include "libdata/measured/order_fit.hpp"

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline data {

OrderFit::OrderFit(const Vec& angle, double middle, double width, const std::vector<double>& orders)
    : weighted_(angle.size(), 1 + 2 * std::ssize(orders)) {
  for (Eigen::Index j = 0; j < angle.size(); ++j) {
    // its square is the window
    const double weight = std::cos(0.5 * turn * (angle(j) - middle) / width);
    weighted_(j, 0) = weight;
    for (std::size_t q = 0; q < orders.size(); ++q) {
      const auto column = static_cast<Eigen::Index>(1 + 2 * q);
      weighted_(j, column) = weight * std::cos(orders[q] * angle(j));
      weighted_(j, column + 1) = -weight * std::sin(orders[q] * angle(j));
    }
  }
  weights_ = weighted_.col(0);
}

Mat OrderFit::of(const Mat& readings) const {
  const Mat normal = weighted_.transpose() * weighted_;
  return DenseLu<Mat>(normal).solve(weighted_.transpose() * Mat(weights_.asDiagonal() * readings));
}

}  // namespace whirl::inline data
