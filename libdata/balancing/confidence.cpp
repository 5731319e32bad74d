#include "libdata/balancing/confidence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace whirl::inline data {

namespace {

constexpr double outside = 20.0;  ///< one over the share that is farther away

}  // namespace

std::optional<ReadingVariance> reading_variance(const std::vector<InfluenceLine>& lines,
                                                const std::vector<std::size_t>& probe,
                                                const Vec& given) {
  const auto probes = static_cast<std::size_t>(given.size());
  std::vector<double> left(probes, 0.0);
  std::vector<Eigen::Index> spare(probes, 0);
  for (std::size_t j = 0; j < lines.size(); ++j) {
    left[probe[j]] += lines[j].left;
    spare[probe[j]] += lines[j].spare;
  }
  ReadingVariance found{Vec::Zero(std::ssize(lines)), std::nullopt};
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const std::size_t p = probe[j];
    const double radius = given(static_cast<Eigen::Index>(p));
    if (spare[p] == 0 && !(radius > 0.0)) return std::nullopt;
    const double of_given = radius * radius / std::log(outside);
    const double of_runs = spare[p] > 0 ? left[p] / static_cast<double>(spare[p]) : 0.0;
    found.variance(static_cast<Eigen::Index>(j)) = std::max(of_given, of_runs);
    if (of_runs > of_given) found.spare = std::min(found.spare.value_or(spare[p]), spare[p]);
  }
  return found;
}

double radius_of_95_percent(std::optional<Eigen::Index> spare) {
  if (!spare) return std::sqrt(std::log(outside));
  const auto n = static_cast<double>(*spare);
  return std::sqrt(n * std::expm1(std::log(outside) / n));
}

BalancingConfidence confidence_of(const std::vector<InfluenceLine>& lines,
                                  const ReadingVariance& readings, const Vec& weight,
                                  const CVec& w) {
  const auto m = std::ssize(lines), n = w.size();
  CMat A(m, n);
  CVec x(n + 1);
  x << Complex(1.0), w;
  for (Eigen::Index j = 0; j < m; ++j) {
    A.row(j) = lines[static_cast<std::size_t>(j)].coefficients.transpose();
  }
  const Vec D = weight.cwiseAbs2();
  // scaled, as columns may be of any size
  Vec scale(n);
  for (Eigen::Index k = 0; k < n; ++k) scale(k) = 1.0 / (weight.asDiagonal() * A.col(k)).norm();
  const CMat As = A * scale.asDiagonal();
  const CMat G = scale.asDiagonal() *
                 (As.adjoint() * D.asDiagonal() * As).ldlt().solve(CMat::Identity(n, n)) *
                 scale.asDiagonal();
  CMat covariance = CMat::Zero(n, n);
  BalancingConfidence found{Vec(n), Vec(m)};
  const double radius = radius_of_95_percent(readings.spare);
  for (Eigen::Index j = 0; j < m; ++j) {
    const InfluenceLine& line = lines[static_cast<std::size_t>(j)];
    const double variance = readings.variance(j),
                 h = (x.transpose() * line.shape * x.conjugate())(0).real();
    const CVec p = D(j) * (G * A.row(j).adjoint());
    const CMat of_coefficients = line.shape.bottomRightCorner(n, n).conjugate();
    covariance += variance * h * (p * p.adjoint());
    covariance +=
        variance * D(j) * D(j) * std::norm(line.at(w)) * (G * of_coefficients * G.adjoint());
    found.readings(j) = radius * std::sqrt(variance * (1.0 + h));
  }
  found.weights = radius * covariance.diagonal().real().cwiseMax(0.0).cwiseSqrt();
  return found;
}

}  // namespace whirl::inline data
