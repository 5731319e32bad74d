#include "libdata/fit/fit_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/sparse_lu.hpp"

namespace whirl::inline data {

namespace {

/// Some columns of a matrix.
Sparse chosen(const Sparse& J, const std::vector<Eigen::Index>& columns) {
  std::vector<Triplet> entries;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    entries.emplace_back(static_cast<int>(columns[i]), static_cast<int>(i), 1.0);
  }
  Sparse choice(J.cols(), std::ssize(columns));
  choice.setFromTriplets(entries.begin(), entries.end());
  return J * choice;
}

/// The equations (R^T R, G^T; G, -slack) of unknowns and multipliers of gaps.
Sparse with_multipliers(const Sparse& R, const Sparse& G, double slack) {
  const Sparse normal = Sparse(R.transpose()) * R;
  std::vector<Triplet> entries;
  const auto add = [&](const Sparse& A, Eigen::Index row, Eigen::Index column, bool is_transposed) {
    for (int outer = 0; outer < A.outerSize(); ++outer) {
      for (Sparse::InnerIterator it(A, outer); it; ++it) {
        const Eigen::Index i = is_transposed ? it.col() : it.row();
        const Eigen::Index j = is_transposed ? it.row() : it.col();
        entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j), it.value());
      }
    }
  };
  const Eigen::Index n = R.cols(), m = G.rows();
  add(normal, 0, 0, false);
  add(G, n, 0, false);
  add(G, 0, n, true);
  for (Eigen::Index i = 0; i < m && slack > 0.0; ++i) {
    entries.emplace_back(static_cast<int>(n + i), static_cast<int>(n + i), -slack);
  }
  Sparse all(n + m, n + m);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

/// What the other unknowns cannot make up for of the columns of some, over readings and gaps; empty
/// where the others are not told.
Mat left_of_columns(const FitJacobian& J, FitGaps kind, const std::vector<Eigen::Index>& some,
                    const std::vector<Eigen::Index>& others) {
  const Sparse R = chosen(J.readings, others), G = chosen(J.gaps, others);
  const double slack = kind == FitGaps::residuals ? 1.0 : 0.0;
  const SparseLu factor(with_multipliers(R, G, slack));
  if (!factor.is_regular()) return {};
  const Eigen::Index n = R.cols(), m = G.rows();
  Mat readings = Mat(chosen(J.readings, some)), left = Mat(chosen(J.gaps, some));
  Mat multipliers = Mat::Zero(m, readings.cols());
  for (int pass = 0; pass < 2; ++pass) {  // the second takes the rounding of the first off
    Mat right(n + m, readings.cols());
    right << -(R.transpose() * readings + G.transpose() * multipliers), slack * multipliers - left;
    const Mat found = factor.solve(right);
    readings += R * found.topRows(n);
    left += G * found.topRows(n);
    multipliers += found.bottomRows(m);
  }
  Mat all(readings.rows() + m, readings.cols());
  all << readings, slack * left;
  return all;
}

}  // namespace

Mat fit_covariance(const FitJacobian& J, FitGaps gaps, const std::vector<bool>& is_held) {
  const auto wanted = std::ssize(is_held);
  const Eigen::Index unknowns = J.readings.cols();
  std::vector<Eigen::Index> free, others;
  for (Eigen::Index i = 0; i < wanted; ++i) {
    if (!is_held[static_cast<std::size_t>(i)]) free.push_back(i);
  }
  for (Eigen::Index i = wanted; i < unknowns; ++i) others.push_back(i);
  Mat found = Mat::Constant(wanted, wanted, std::nan(""));
  found(free, free).setConstant(std::numeric_limits<double>::infinity());
  if (unknowns == 0 || free.empty()) return found;

  // what is left of the columns that are wanted once the others have made up for all they can
  const Mat own = left_of_columns(J, gaps, free, others);
  if (own.cols() == 0 || !own.allFinite()) return found;

  std::vector<Eigen::Index> touched, among;  // that readings depend on; the places of these in own
  for (Eigen::Index i = 0; i < own.cols(); ++i) {
    if (own.col(i).isZero(0.0)) continue;
    touched.push_back(free[static_cast<std::size_t>(i)]);
    among.push_back(i);
  }
  if (touched.empty()) return found;
  const Mat columns = own(Eigen::all, among);
  const Vec per = columns.colwise().norm().cwiseInverse();
  const Mat scaled = columns * per.asDiagonal();
  const auto told = symmetric_modes(Mat(scaled.transpose() * scaled));
  constexpr double least = 1e-12;  // of what a direction is told, beside rounding
  const Vec variance = told.values.cwiseMax(least).cwiseInverse();
  const Mat directions = per.asDiagonal() * told.vectors;
  found(touched, touched) = directions * variance.asDiagonal() * directions.transpose();
  return found;
}

}  // namespace whirl::inline data
