#include "libdata/measured/subspace.hpp"

#include <algorithm>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/singular_values.hpp"

namespace whirl::inline data {

OutputProducts& OutputProducts::operator+=(const OutputProducts& other) {
  if (sums.empty()) return *this = other;
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += other.sums[k];
  count += other.count;
  return *this;
}

OutputProducts& OutputProducts::operator-=(const OutputProducts& other) {
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] -= other.sums[k];
  count -= other.count;
  return *this;
}

OutputProducts output_products(const Mat& samples, int lags, Eigen::Index first,
                               Eigen::Index count) {
  OutputProducts products;
  products.count = static_cast<double>(count);
  const auto now = samples.middleRows(first, count);
  for (int k = 0; k < lags; ++k) {
    products.sums.push_back(samples.middleRows(first + k, count).transpose() * now);
  }
  return products;
}

SubspaceModels::SubspaceModels(const OutputProducts& products, int block_rows, int most_order) {
  const auto channels = products.sums.front().rows();
  const Eigen::Index i = block_rows;
  Mat T(i * channels, i * channels);
  for (Eigen::Index row = 0; row < i; ++row) {
    for (Eigen::Index column = 0; column < i; ++column) {
      const auto lag = static_cast<std::size_t>(i + row - column);
      T.block(row * channels, column * channels, channels, channels) =
          products.sums[lag] / products.count;
    }
  }
  const LeftSingular svd = left_singular(T);
  singular_values_ = svd.values;
  constexpr double nothing = 1e-12;  // of the largest one: directions that are rounding alone
  Eigen::Index rank = 0;
  while (rank < most_order && svd.values(rank) > nothing * svd.values(0)) ++rank;

  const Mat O = svd.vectors.leftCols(rank);
  C_ = O.topRows(channels);
  const ThinQr qr = thin_qr(O.topRows((i - 1) * channels));
  R_ = qr.R;
  shifted_ = qr.Q.transpose() * O.bottomRows((i - 1) * channels);
}

std::vector<Pole> SubspaceModels::poles(int order, double spacing) const {
  const auto R = R_.topLeftCorner(order, order).triangularView<Eigen::Upper>();
  const auto found = general_modes(R.solve(shifted_.topLeftCorner(order, order)));
  std::vector<Pole> poles;
  if (!found) return poles;
  const CMat shapes = C_.leftCols(order) * found->vectors;
  for (Eigen::Index j = 0; j < order; ++j) {
    const Complex mu = found->values(j);
    if (mu.imag() <= 0.0) continue;
    poles.push_back({std::log(mu) / spacing, shapes.col(j).normalized()});
  }
  std::sort(poles.begin(), poles.end(),
            [](const Pole& a, const Pole& b) { return a.frequency() < b.frequency(); });
  return poles;
}

}  // namespace whirl::inline data
