#include "libdyn/fit/fit_least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline dyn {

namespace {

/// Residuals of a window.
class WindowCost : public ceres::CostFunction {
 public:
  WindowCost(const FitSearch& search, std::size_t shooting, std::size_t window)
      : search_(search), shooting_(search.shootings[shooting]), window_(shooting_.windows[window]) {
    set_num_residuals(static_cast<int>(window_.residuals()));
    auto& sizes = *mutable_parameter_block_sizes();
    sizes.push_back(static_cast<int>(search.x.size()));
    sizes.push_back(static_cast<int>(window_.states()));
    if (window_.has_next()) sizes.push_back(static_cast<int>(window_.states()));
    if (shooting_.has_offset()) sizes.push_back(static_cast<int>(shooting_.offset.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!shooting_.system) return false;
    const Eigen::Index n = window_.states(), m = window_.readings(), all = window_.residuals();
    const Vec& scale = shooting_.scale;
    const Vec start = Vec::Map(blocks[1], n).cwiseProduct(scale);
    const bool slopes = jacobians && (jacobians[0] || jacobians[1]);
    const Eigen::Index probes = shooting_.offset.size();
    const int last = window_.has_next() ? 3 : 2;
    const double* offset = shooting_.has_offset() ? blocks[last] : shooting_.offset.data();
    const auto found = window_.compare(*shooting_.system, start,
                                       Vec::Map(offset, probes) * shooting_.length, slopes);
    if (!found.is_good) return false;
    Eigen::Map<Vec> r(residuals, all);
    r.head(m) = found.readings;
    const Vec per_gap = (shooting_.gap * search_.between).cwiseInverse();
    if (window_.has_next()) {
      const Vec next = Vec::Map(blocks[2], n).cwiseProduct(scale);
      r.tail(n) = (found.end - next).cwiseProduct(per_gap);
    }
    if (!jacobians) return true;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto fill = [&](int block, const Mat& top, const Mat& bottom, const Vec& per) {
      if (!jacobians[block]) return;
      Eigen::Map<Rows> J(jacobians[block], all, per.size());
      J.topRows(m) = top * per.asDiagonal();
      if (window_.has_next()) J.bottomRows(n) = per_gap.asDiagonal() * bottom * per.asDiagonal();
    };
    if (slopes) {
      fill(0, found.readings_by_parameter, found.end_by_parameter, search_.sizes);
      fill(1, found.readings_by_start, found.end_by_start, scale);
    }
    if (window_.has_next()) fill(2, Mat::Zero(m, n), -Mat::Identity(n, n), scale);
    if (shooting_.has_offset()) {
      fill(last, window_.readings_by_offset(), Mat::Zero(n, probes),
           Vec::Constant(probes, shooting_.length));
    }
    return true;
  }

 private:
  const FitSearch& search_;
  const RecordShooting& shooting_;
  const ShootingWindow& window_;
};

/// With a search that is told what Ceres looks at next.
ceres::Problem::Options telling(FitSearch& search) {
  ceres::Problem::Options options;
  options.evaluation_callback = &search;
  return options;
}

}  // namespace

FitLeastSquares::FitLeastSquares(FitSearch& search)
    : search_(search), problem_(telling(search)), stop_(search.options) {
  problem_.AddParameterBlock(search.x.data(), static_cast<int>(search.x.size()));
  for (std::size_t p = 0; p < search.parameters.size(); ++p) {
    const FreeParameter& parameter = search.parameters[p];
    const int i = static_cast<int>(p);
    if (std::isfinite(parameter.lower)) {
      problem_.SetParameterLowerBound(search.x.data(), i, parameter.lower / parameter.size);
    }
    if (std::isfinite(parameter.upper)) {
      problem_.SetParameterUpperBound(search.x.data(), i, parameter.upper / parameter.size);
    }
  }
  for (std::size_t s = 0; s < search.shootings.size(); ++s) {
    RecordShooting& shooting = search.shootings[s];
    for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
      std::vector<double*> blocks{search.x.data(), shooting.starts[w].data()};
      if (shooting.windows[w].has_next()) {
        blocks.push_back(shooting.starts[(w + 1) % shooting.starts.size()].data());
      }
      if (shooting.has_offset()) blocks.push_back(shooting.offset.data());
      problem_.AddResidualBlock(new WindowCost(search, s, w), nullptr, blocks);
    }
  }
}

ceres::Solver::Summary FitLeastSquares::solve(double between, int most_iterations,
                                              double tolerance) {
  search_.between = between;
  ceres::Solver::Options options;
  options.trust_region_strategy_type = ceres::DOGLEG;
  options.use_nonmonotonic_steps = true;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&stop_);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  iterations_ += static_cast<int>(summary.iterations.size());
  return summary;
}

ceres::Solver::Summary FitLeastSquares::finish(double between, int most_iterations,
                                               double tolerance) {
  constexpr int before_leap = 15;
  const int begun = iterations_;
  for (;;) {
    const int left = most_iterations - (iterations_ - begun);
    auto summary = solve(between, std::clamp(left, 1, before_leap), tolerance);
    const bool goes_on = summary.termination_type == ceres::NO_CONVERGENCE;
    if (!goes_on || left <= before_leap) return summary;
    leap(between);
  }
}

Sparse FitLeastSquares::jacobian() {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks.push_back(search_.x.data());
  for (RecordShooting& shooting : search_.shootings) {
    if (shooting.has_offset()) options.parameter_blocks.push_back(shooting.offset.data());
  }
  for (RecordShooting& shooting : search_.shootings) {
    for (Vec& start : shooting.starts) options.parameter_blocks.push_back(start.data());
  }
  ceres::CRSMatrix found;
  if (!problem_.Evaluate(options, nullptr, nullptr, nullptr, &found)) return {};
  return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
      found.num_rows, found.num_cols, static_cast<Eigen::Index>(found.values.size()),
      found.rows.data(), found.cols.data(), found.values.data());
}

std::vector<Eigen::Index> FitLeastSquares::idle_parameters() {
  std::vector<Eigen::Index> idle;
  const Sparse J = jacobian();
  for (Eigen::Index p = 0; p < std::min<Eigen::Index>(search_.x.size(), J.cols()); ++p) {
    if (J.col(p).squaredNorm() == 0.0) idle.push_back(p);
  }
  return idle;
}

bool FitLeastSquares::does_something_at(double x, Eigen::Index parameter) {
  const FreeParameter& p = search_.parameters[static_cast<std::size_t>(parameter)];
  const double value = x * p.size;
  if (!(value > p.lower && value < p.upper)) return false;
  search_.x(parameter) = x;
  const Sparse J = jacobian();
  return J.cols() > parameter && J.col(parameter).squaredNorm() > 0.0;
}

bool FitLeastSquares::rouse() {
  constexpr double noises = 1.5;  // that may be left of records that are explained
  constexpr double step = 0.97, furthest = 1.0 / 3.0, beyond = 0.9;
  double cost = 0.0;
  if (!problem_.Evaluate({}, &cost, nullptr, nullptr, nullptr)) return false;
  if (2.0 * cost < noises * noises * static_cast<double>(search_.readings())) return false;
  std::vector<Eigen::Index> idle = idle_parameters();
  std::erase_if(idle, [&](Eigen::Index p) { return search_.x(p) == 0.0; });  // times what it may be
  if (idle.empty()) return false;
  for (double factor = step; factor > furthest; factor *= step) {
    if (search_.options.is_stopped && search_.options.is_stopped()) return false;
    for (const Eigen::Index p : idle) {
      const double own = search_.x(p);
      for (const double way : {factor, 1.0 / factor}) {
        if (!does_something_at(own * way, p)) continue;
        const double further = way < 1.0 ? beyond : 1.0 / beyond;
        if (!does_something_at(own * way * further, p)) search_.x(p) = own * way;
        return true;
      }
      search_.x(p) = own;
    }
  }
  return false;
}

std::vector<Eigen::Map<Vec>> FitLeastSquares::unknowns() {
  const auto map = [](Vec& v) { return Eigen::Map<Vec>(v.data(), v.size()); };
  std::vector<Eigen::Map<Vec>> all{map(search_.x)};
  for (RecordShooting& shooting : search_.shootings) {
    if (shooting.has_offset()) all.push_back(map(shooting.offset));
    for (Vec& start : shooting.starts) all.push_back(map(start));
  }
  return all;
}

Vec FitLeastSquares::place() {
  std::vector<double> all;
  for (const auto& one : unknowns()) all.insert(all.end(), one.begin(), one.end());
  return Vec::Map(all.data(), std::ssize(all));
}

double FitLeastSquares::go_to(const Vec& place) {
  Eigen::Index at = 0;
  for (auto& one : unknowns()) {
    one = place.segment(at, one.size());
    at += one.size();
  }
  const Vec values = search_.values();
  for (std::size_t p = 0; p < search_.parameters.size(); ++p) {
    const FreeParameter& parameter = search_.parameters[p];
    const double value = values(static_cast<Eigen::Index>(p));
    if (value < parameter.lower || value > parameter.upper) return HUGE_VAL;
  }
  double cost = HUGE_VAL;
  return problem_.Evaluate({}, &cost, nullptr, nullptr, nullptr) ? cost : HUGE_VAL;
}

void FitLeastSquares::leap(double between) {
  constexpr double along = 0.9, furthest = 100.0;  // cosine of two such steps; times the last one
  const Vec first = place();
  solve(between, 1, 0.0);
  const Vec second = place();
  const double cost = solve(between, 1, 0.0).final_cost;
  const Vec third = place(), b = second - first, c = third - second;
  const double q = c.dot(b) / b.squaredNorm();
  if (!(c.dot(b) > along * c.norm() * b.norm()) || !(q < 1.0)) return;
  for (double far = std::min(q / (1.0 - q), furthest); far > 1.0; far *= 0.5) {
    if (go_to(third + far * c) < cost) return;
  }
  go_to(third);
}

}  // namespace whirl::inline dyn
