#include "libdata/balancing/influence.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"

namespace whirl::inline data {

namespace {

/// Singular values of the scaled weights below which runs do not determine a plane.
constexpr double undetermined = 1e-9;

/// The plane that takes most of a direction.
const std::string& plane_of(const CVec& direction, const std::vector<std::string>& planes) {
  Eigen::Index at = 0;
  direction.tail(std::ssize(planes)).cwiseAbs().maxCoeff(&at);
  return planes[static_cast<std::size_t>(at)];
}

InfluenceLine line_through(const std::vector<const BalancingRun*>& runs, Eigen::Index reading,
                           const std::vector<std::string>& planes) {
  const auto count = std::ssize(runs), unknowns = std::ssize(planes) + 1;
  CMat X(count, unknowns);
  CVec V(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const BalancingRun& run = *runs[static_cast<std::size_t>(r)];
    X(r, 0) = 1.0;
    X.row(r).tail(unknowns - 1) = run.weights.transpose();
    V(r) = run.readings(reading);
  }
  Vec scale = Vec::Ones(unknowns);  // of the columns, so that weights count like the constant
  for (Eigen::Index k = 1; k < unknowns; ++k) {
    const double largest = count > 0 ? X.col(k).cwiseAbs().maxCoeff() : 0.0;
    if (!(largest > 0.0)) {
      throw OptionError(fmt::format("no run has a trial weight in plane {}",
                                    planes[static_cast<std::size_t>(k - 1)]));
    }
    scale(k) = largest;
  }
  const CMat scaled = X * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<CMat> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Vec& values = svd.singularValues();
  if (count < unknowns || values(unknowns - 1) < undetermined * values(0)) {
    throw OptionError(
        fmt::format("these runs do not tell what a weight in plane {} does: {} planes need a run "
                    "without weights and one more for each, whose weights are not those of others",
                    plane_of(svd.matrixV().col(unknowns - 1), planes), planes.size()));
  }
  InfluenceLine line;
  const CMat inverse = svd.matrixV() * values.cwiseInverse().asDiagonal();
  const CVec beta = scale.cwiseInverse().asDiagonal() * (inverse * (svd.matrixU().adjoint() * V));
  line.start = beta(0);
  line.coefficients = beta.tail(unknowns - 1);
  line.shape = scale.cwiseInverse().asDiagonal() * (inverse * inverse.adjoint()) *
               scale.cwiseInverse().asDiagonal();
  line.spare = count - unknowns;
  line.left = line.spare > 0 ? (X * beta - V).squaredNorm() : 0.0;
  for (Eigen::Index r = 1; r < count; ++r) {
    line.moved = std::max(line.moved, (V.head(r).array() - V(r)).abs().maxCoeff());
  }
  return line;
}

bool is_read(const BalancingRun& run, Eigen::Index reading) {
  return std::isfinite(std::abs(run.readings(reading)));
}

}  // namespace

std::vector<InfluenceLine> influence_lines(const std::vector<BalancingRun>& runs,
                                           const std::vector<std::string>& planes) {
  std::vector<InfluenceLine> lines;
  for (Eigen::Index j = 0; j < runs.front().readings.size(); ++j) {
    std::vector<const BalancingRun*> read;
    for (const BalancingRun& run : runs) {
      if (is_read(run, j)) read.push_back(&run);
    }
    lines.push_back(line_through(read, j, planes));
  }
  return lines;
}

std::vector<InfluenceLine> lines_of_model(const std::vector<BalancingRun>& runs,
                                          const CMat& coefficients) {
  std::vector<InfluenceLine> lines;
  for (Eigen::Index j = 0; j < coefficients.rows(); ++j) {
    InfluenceLine line;
    line.coefficients = coefficients.row(j).transpose();
    std::vector<Complex> starts;
    for (const BalancingRun& run : runs) {
      if (!is_read(run, j)) continue;
      starts.push_back(run.readings(j) - (coefficients.row(j) * run.weights)(0));
    }
    if (starts.empty()) throw OptionError("a reading is in none of the runs");
    const auto count = static_cast<double>(starts.size());
    for (const Complex start : starts) line.start += start / count;
    const Eigen::Index unknowns = coefficients.cols() + 1;
    line.shape = CMat::Zero(unknowns, unknowns);
    line.shape(0, 0) = 1.0 / count;
    line.spare = std::ssize(starts) - 1;
    for (const Complex start : starts) {
      line.left += std::norm(start - line.start);
      for (const Complex other : starts) line.moved = std::max(line.moved, std::abs(start - other));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

double nonlinearity(const std::vector<InfluenceLine>& lines, const std::vector<BalancingRun>& runs,
                    const Vec& weight) {
  double largest = 0.0, moved = 0.0;
  for (std::size_t j = 0; j < lines.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    moved = std::max(moved, weight(row) * lines[j].moved);
    if (lines[j].spare == 0) continue;
    for (const BalancingRun& run : runs) {
      if (!is_read(run, row)) continue;
      const double off = std::abs(run.readings(row) - lines[j].at(run.weights));
      largest = std::max(largest, weight(row) * off);
    }
  }
  return moved > 0.0 ? largest / moved : 0.0;
}

}  // namespace whirl::inline data
