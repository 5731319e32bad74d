#include "libdyn/fit/fit_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/dense.hpp"
#include "libbase/sparse_lu.hpp"

namespace whirl::inline dyn {

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

}  // namespace

Mat fit_covariance(const Sparse& J, const std::vector<bool>& is_held) {
  const auto wanted = std::ssize(is_held);
  std::vector<Eigen::Index> free, others;
  for (Eigen::Index i = 0; i < wanted; ++i) {
    if (!is_held[static_cast<std::size_t>(i)]) free.push_back(i);
  }
  for (Eigen::Index i = wanted; i < J.cols(); ++i) others.push_back(i);
  Mat found = Mat::Constant(wanted, wanted, std::nan(""));
  found(free, free).setConstant(std::numeric_limits<double>::infinity());
  if (J.cols() == 0 || free.empty()) return found;

  // what is left of the columns that are wanted once the others have made up for all they can
  const Sparse rest = chosen(J, others);
  Mat own = Mat(chosen(J, free));
  const SparseLu factor(Sparse(rest.transpose() * rest));
  if (!factor.is_regular()) return found;
  for (int pass = 0; pass < 2; ++pass) own -= rest * factor.solve(rest.transpose() * own);
  if (!own.allFinite()) return found;

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

}  // namespace whirl::inline dyn
