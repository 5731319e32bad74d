#include "libdyn/fit/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libbase/sparse_lu.hpp"
#include "libdyn/fit/shooting_windows.hpp"

namespace whirl::inline dyn {

namespace {

/// What may be left between windows, in noises: at first it hardly counts, at last it has to be nothing.
constexpr std::array<double, 9> gaps{100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01};
constexpr int rough_iterations = 60;  ///< of all but the last of these
constexpr double rough_change =
    1e-4;  ///< of the sum of squares, in an iteration that is the last of them
/// The same of the last one, in squares of what is left of a reading: parameters move by less than a
/// thirtieth of their deviations then. States that no probe sees may go on moving for long.
constexpr double last_change = 1e-3;
/// Standard deviations of the sum of squares beyond which chance does not leave so much.
constexpr double improbable = 6.0;
constexpr double confidence = 1.959963985;  ///< standard deviations to either side of 95 %

/// A record during the search.
struct Shooting {
  const FitSource* source;
  std::vector<ShootingWindow> windows;
  std::vector<Vec> starts;  ///< of windows, over scale
  Vec scale;                ///< of states
  Vec gap;                  ///< of the state between windows that counts as one noise
  /// At the parameters that are looked at; nothing: there is none.
  std::optional<FitSystem> system;
};

/// What is searched for, and the systems at the parameters that Ceres looks at.
struct Search : ceres::EvaluationCallback {
  Search(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
         const FitOptions& asked);

  void PrepareForEvaluation(bool, bool is_new) override {
    if (is_new) make_systems();
  }

  long readings() const;
  /// Values of the parameters that are looked at.
  Vec values() const { return x.cwiseProduct(sizes); }
  void make_systems();

  const std::vector<FreeParameter>& parameters;
  const FitOptions& options;
  Vec x;      ///< parameters over their sizes
  Vec sizes;  ///< of parameters
  std::vector<Shooting> shootings;
  double between = gaps[0];  ///< see gaps
};

/// Residuals of a window.
class WindowCost : public ceres::CostFunction {
 public:
  WindowCost(const Search& search, std::size_t shooting, std::size_t window)
      : search_(search), shooting_(search.shootings[shooting]), window_(shooting_.windows[window]) {
    set_num_residuals(static_cast<int>(window_.residuals()));
    auto& sizes = *mutable_parameter_block_sizes();
    sizes.push_back(static_cast<int>(search.x.size()));
    sizes.push_back(static_cast<int>(window_.states()));
    if (!window_.is_last()) sizes.push_back(static_cast<int>(window_.states()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    if (!shooting_.system) return false;
    const Eigen::Index n = window_.states(), m = window_.readings(), all = window_.residuals();
    const Vec& scale = shooting_.scale;
    const Vec start = Vec::Map(blocks[1], n).cwiseProduct(scale);
    const bool slopes = jacobians && (jacobians[0] || jacobians[1]);
    const auto found = window_.compare(*shooting_.system, start, slopes);
    if (!found.is_good) return false;
    Eigen::Map<Vec> r(residuals, all);
    r.head(m) = found.readings;
    const Vec per_gap = (shooting_.gap * search_.between).cwiseInverse();
    if (!window_.is_last()) {
      const Vec next = Vec::Map(blocks[2], n).cwiseProduct(scale);
      r.tail(n) = (found.end - next).cwiseProduct(per_gap);
    }
    if (!jacobians) return true;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto fill = [&](int block, const Mat& top, const Mat& bottom, const Vec& per) {
      if (!jacobians[block]) return;
      Eigen::Map<Rows> J(jacobians[block], all, per.size());
      J.topRows(m) = top * per.asDiagonal();
      if (!window_.is_last()) J.bottomRows(n) = per_gap.asDiagonal() * bottom * per.asDiagonal();
    };
    if (slopes) {
      fill(0, found.readings_by_parameter, found.end_by_parameter, search_.sizes);
      fill(1, found.readings_by_start, found.end_by_start, scale);
    }
    if (!window_.is_last()) fill(2, Mat::Zero(m, n), -Mat::Identity(n, n), scale);
    return true;
  }

 private:
  const Search& search_;
  const Shooting& shooting_;
  const ShootingWindow& window_;
};

void require_fit(const std::vector<FitSource>& sources,
                 const std::vector<FreeParameter>& parameters) {
  for (const FreeParameter& p : parameters) {
    if (!(p.size > 0.0)) {
      throw ModelError({}, p.path,
                       "a free parameter that is zero needs bounds, such as PATH=0:0.4");
    }
    if (p.start >= p.lower && p.start <= p.upper) continue;
    throw ModelError({}, p.path,
                     fmt::format("begins at {:.6g}, which is outside of {:.6g} to {:.6g}", p.start,
                                 p.lower, p.upper));
  }
  for (const FitSource& source : sources) {
    const FitRecord& record = source.record;
    if (record.times.size() < 2 || !record.readings.array().isFinite().any()) {
      throw ModelError({}, record.name, "has no readings to fit to");
    }
    if (!(record.noise.array() > 0.0).all()) {
      throw ModelError({}, record.name, "needs the noise of every probe, > 0");
    }
  }
}

Search::Search(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
               const FitOptions& asked)
    : parameters(free), options(asked) {
  const auto count = std::ssize(free);
  x.resize(count);
  sizes.resize(count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const FreeParameter& parameter = free[static_cast<std::size_t>(p)];
    sizes(p) = parameter.size;
    x(p) = parameter.start / parameter.size;
  }
  for (const FitSource& source : sources) {
    Shooting shooting{&source, {}, {}, {}, {}, source.system_at(values())};
    const ContactSystem& system = shooting.system->system;
    const Eigen::Index n = system.coordinates();
    const double duration = options.window > 0.0 ? options.window : system.period();
    shooting.windows = shooting_windows(source, duration);
    shooting.scale = system.state_scale();
    // coordinates that move the probes by their noise, and the rates that do so within a radian
    shooting.gap = shooting.scale * (source.record.noise.mean() / system.length_scale());
    shooting.gap.tail(n) = shooting.gap.head(n) * system.phase_rate();
    for (const ShootingWindow& window : shooting.windows) {
      shooting.starts.push_back(window.guess().cwiseQuotient(shooting.scale));
    }
    shootings.push_back(std::move(shooting));
  }
}

long Search::readings() const {
  long all = 0;
  for (const Shooting& shooting : shootings) {
    for (const ShootingWindow& window : shooting.windows) all += window.readings();
  }
  return all;
}

void Search::make_systems() {
  for (Shooting& shooting : shootings) {
    try {
      shooting.system = shooting.source->system_at(values());
    } catch (const std::runtime_error&) {  // values that make no system: Ceres takes a shorter step
      shooting.system.reset();
    }
  }
}

/// With a search that is told what Ceres looks at next.
ceres::Problem::Options telling(Search& search) {
  ceres::Problem::Options options;
  options.evaluation_callback = &search;
  return options;
}

/// Stops Ceres where somebody asks for it.
class Interruption : public ceres::IterationCallback {
 public:
  explicit Interruption(const FitOptions& options) : options_(options) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return options_.is_stopped && options_.is_stopped() ? ceres::SOLVER_ABORT
                                                        : ceres::SOLVER_CONTINUE;
  }

 private:
  const FitOptions& options_;
};

/// The least squares of a search, for Ceres.
class LeastSquares {
 public:
  explicit LeastSquares(Search& search)
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
      Shooting& shooting = search.shootings[s];
      for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
        std::vector<double*> blocks{search.x.data(), shooting.starts[w].data()};
        if (!shooting.windows[w].is_last()) blocks.push_back(shooting.starts[w + 1].data());
        problem_.AddResidualBlock(new WindowCost(search, s, w), nullptr, blocks);
      }
    }
  }

  /// Powell's dogleg, whose steps may make things worse for a while: the valleys of motions that must be
  /// one are narrow and bent. Levenberg and Marquardt's way gets stuck in them in a fifth of the twin
  /// experiments of chaos (bench/fit_twins.cpp).
  /// @param between  as gaps
  ceres::Solver::Summary solve(double between, int most_iterations, double tolerance) {
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
    return summary;
  }

  void hold_parameters() { problem_.SetParameterBlockConstant(search_.x.data()); }
  void free_parameters() { problem_.SetParameterBlockVariable(search_.x.data()); }

  /// Derivatives of all residuals, the parameters first; empty where a motion does not get through.
  Sparse jacobian() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks.push_back(search_.x.data());
    for (Shooting& shooting : search_.shootings) {
      for (Vec& start : shooting.starts) options.parameter_blocks.push_back(start.data());
    }
    ceres::CRSMatrix found;
    if (!problem_.Evaluate(options, nullptr, nullptr, nullptr, &found)) return {};
    return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
        found.num_rows, found.num_cols, static_cast<Eigen::Index>(found.values.size()),
        found.rows.data(), found.cols.data(), found.values.data());
  }

 private:
  Search& search_;
  ceres::Problem problem_;
  Interruption stop_;
};

/// Covariance of those parameters that are free to move, over their sizes: their part of the inverse of
/// J^T J. NaN of those that a bound holds; infinite where there is no inverse.
Mat covariance(const Sparse& J, const std::vector<bool>& is_held) {
  const auto parameters = std::ssize(is_held);
  std::vector<Eigen::Index> free;
  for (std::size_t p = 0; p < is_held.size(); ++p) {
    if (!is_held[p]) free.push_back(static_cast<Eigen::Index>(p));
  }
  Mat found = Mat::Constant(parameters, parameters, std::nan(""));
  found(free, free).setConstant(std::numeric_limits<double>::infinity());
  if (J.cols() == 0) return found;

  std::vector<Triplet> entries;  // 1 from an unknown to its column among the free ones
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    if (i < parameters && is_held[static_cast<std::size_t>(i)]) continue;
    entries.emplace_back(static_cast<int>(i), static_cast<int>(entries.size()), 1.0);
  }
  Sparse choice(J.cols(), std::ssize(entries));
  choice.setFromTriplets(entries.begin(), entries.end());
  const Sparse J_free = J * choice;
  const Sparse normal = J_free.transpose() * J_free;
  const SparseLu factor(normal);
  if (!factor.is_regular()) return found;
  const auto count = std::ssize(free);
  const Mat columns = factor.solve(Mat::Identity(normal.rows(), count));
  const Mat inverse = columns.topRows(count);
  if (inverse.allFinite() && (inverse.diagonal().array() > 0.0).all()) found(free, free) = inverse;
  return found;
}

/// What is left, and what the motions that were found read.
void add_residuals(Fit& fit, const Search& search) {
  double squares = 0.0, logarithms = 0.0;
  for (const Shooting& shooting : search.shootings) {
    const FitRecord& record = shooting.source->record;
    FitResidual left{record.name, {}, Mat(record.readings.rows(), record.readings.cols())};
    for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
      const ShootingWindow& window = shooting.windows[w];
      const Vec start = shooting.starts[w].cwiseProduct(shooting.scale);
      const Mat read = window.predict(*shooting.system, start);
      left.predicted.middleCols(window.first_sample(), read.cols()) = read;
    }
    const Mat off = left.predicted - record.readings;
    left.of_probe.resize(off.rows());
    for (Eigen::Index probe = 0; probe < off.rows(); ++probe) {
      double sum = 0.0, count = 0.0;
      for (const double e : off.row(probe)) {
        if (!std::isfinite(e)) continue;
        sum += e * e;
        count += 1.0;
      }
      left.of_probe(probe) = std::sqrt(sum / count);
      const double noise = record.noise(probe);
      squares += sum / (noise * noise);
      logarithms += count * std::log(turn * noise * noise);
      fit.readings += static_cast<long>(count);
    }
    fit.windows += std::ssize(shooting.windows);
    fit.records.push_back(std::move(left));
  }
  fit.residual = std::sqrt(squares / static_cast<double>(fit.readings));
  fit.log_likelihood = -0.5 * (squares + logarithms);
}

/// The parameters with their errors.
void add_parameters(Fit& fit, const Search& search, const Sparse& J) {
  const Vec values = search.values();
  std::vector<bool> is_held;
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    const FreeParameter& parameter = search.parameters[static_cast<std::size_t>(p)];
    const double near = 1e-9 * parameter.size;
    is_held.push_back(values(p) - parameter.lower < near || parameter.upper - values(p) < near);
  }
  Mat C = covariance(J, is_held);
  if (!search.options.is_noise_known) C *= fit.residual * fit.residual;
  const Vec deviation = C.diagonal().cwiseSqrt();
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    const FreeParameter& parameter = search.parameters[static_cast<std::size_t>(p)];
    const double off = deviation(p) * parameter.size;
    fit.parameters.push_back({.path = parameter.path,
                              .unit = parameter.unit,
                              .start = parameter.start,
                              .value = values(p),
                              .standard_deviation = off,
                              .lower = values(p) - confidence * off,
                              .upper = values(p) + confidence * off,
                              .is_told = confidence * off < std::abs(values(p)),
                              .is_at_bound = is_held[static_cast<std::size_t>(p)]});
  }
  const Vec per = deviation.cwiseInverse();
  fit.correlation = per.asDiagonal() * C * per.asDiagonal();
}

}  // namespace

Fit fit(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& parameters,
        const FitOptions& options) {
  require_fit(sources, parameters);
  Search search(sources, parameters, options);
  LeastSquares squares(search);
  Fit fit;
  squares.hold_parameters();
  squares.solve(gaps[0], 10, 1e-2);
  squares.free_parameters();
  const double enough = last_change / static_cast<double>(search.readings());
  for (std::size_t stage = 0; stage < gaps.size(); ++stage) {
    const bool is_last = stage + 1 == gaps.size();
    const auto summary =
        squares.solve(gaps[stage], is_last ? options.most_iterations : rough_iterations,
                      is_last ? enough : rough_change);
    fit.iterations += static_cast<int>(summary.iterations.size());
    fit.has_converged = summary.termination_type == ceres::CONVERGENCE;
    if (!fit.has_converged) fit.why_not = summary.message;
    if (!fit.has_converged && summary.termination_type != ceres::NO_CONVERGENCE) break;
    if (options.progress) options.progress(static_cast<long>(stage) + 1, std::ssize(gaps));
  }
  search.make_systems();
  add_residuals(fit, search);
  add_parameters(fit, search, squares.jacobian());
  if (!fit.has_converged) return fit;
  fit.why_not.clear();
  const double most =
      std::sqrt(1.0 + improbable * std::sqrt(2.0 / static_cast<double>(fit.readings)));
  if (options.is_noise_known && fit.residual > most) {
    fit.has_converged = false;
    fit.why_not = fmt::format(
        "what is left is {:.4g} times the noise: the model does not explain the records, or "
        "another "
        "start finds more",
        fit.residual);
  }
  return fit;
}

}  // namespace whirl::inline dyn
