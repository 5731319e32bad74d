#include "libdyn/fit/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libdyn/fit/fit_covariance.hpp"
#include "libdyn/fit/shooting_windows.hpp"
#include "libdyn/motions/equilibrium.hpp"

namespace whirl::inline dyn {

namespace {

/// What may be left between windows, in noises: at first it hardly counts, at last it has to be nothing.
constexpr std::array<double, 9> gaps{100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01};
/// And then of steady motions, which close: what a gap lets through of a motion that does not seems to
/// tell parameters that the steady one does not (as the stiffness in a full annular rub).
constexpr std::array<double, 2> closing{1e-3, 1e-4};
constexpr int rough_iterations = 60;  ///< of all but the last of these
/// Change of the sum of squares in an iteration that ends one of them.
constexpr double rough_change = 1e-4;
/// Change in an iteration that ends the search, in mean squares of a reading: parameters move by a
/// hundredth of their deviations then.
constexpr double last_change = 1e-4;
/// Windows a revolution of a steady motion: a period is little to guess states from, and the shorter windows
/// are the nearer they follow it whatever the parameters are. Where the first number leads nowhere the
/// others may.
constexpr std::array<int, 3> steady_windows{8, 16, 4};
/// Standard deviations of the sum of squares beyond which chance does not leave so much.
constexpr double improbable = 6.0;
constexpr double confidence = 1.959963985;  ///< standard deviations to either side of 95 %

/// A record during the search.
struct Shooting {
  const FitSource* source;
  std::vector<ShootingWindow> windows{};
  std::vector<Vec> starts{};  ///< of windows, over scale
  Vec scale{};                ///< of states
  Vec gap{};                  ///< of the state between windows that counts as one noise
  Vec offset{};               ///< of readings, over length, per probe; zero where it is known
  double length = 1.0;        ///< scale of displacements [m]
  /// At the parameters that are looked at; nothing: there is none.
  std::optional<FitSystem> system;

  bool has_offset() const { return !source->record.is_offset_known; }
};

/// What is searched for, and the systems at the parameters that Ceres looks at.
struct Search : ceres::EvaluationCallback {
  Search(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
         const FitOptions& asked, int steady_windows_per_revolution);

  void PrepareForEvaluation(bool, bool is_new) override {
    if (is_new) make_systems();
  }

  long readings() const;
  /// Values of the parameters that are looked at.
  Vec values() const { return x.cwiseProduct(sizes); }
  void make_systems();
  bool has_steady() const {
    return std::any_of(shootings.begin(), shootings.end(),
                       [](const Shooting& s) { return s.source->record.period > 0; });
  }

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

/// As if the motion was about where the rotor rests.
Vec likely_offset(const FitSource& source, const ContactSystem& system) {
  const Mat& readings = source.record.readings;
  Vec offset = Vec::Zero(readings.rows());
  for (Eigen::Index probe = 0; probe < offset.size(); ++probe) {
    const auto is_there = readings.row(probe).array().isFinite();
    offset(probe) = is_there.select(readings.row(probe).array(), 0.0).sum() /
                    std::max(1.0, is_there.cast<double>().sum());
  }
  try {
    return offset - source.rows * equilibrium(system);
  } catch (const NumericalError&) {  // it rests nowhere
    return offset;
  }
}

Search::Search(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
               const FitOptions& asked, int steady_windows_per_revolution)
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
    Shooting shooting{.source = &source, .system = source.system_at(values())};
    const ContactSystem& system = shooting.system->system;
    const Eigen::Index n = system.coordinates();
    const int share = source.record.period > 0 ? steady_windows_per_revolution : 1;
    const double duration = options.window > 0.0 ? options.window : system.period() / share;
    shooting.windows = shooting_windows(source, duration, system);
    shooting.length = system.length_scale();
    shooting.offset = Vec::Zero(source.rows.rows());
    if (shooting.has_offset()) shooting.offset = likely_offset(source, system) / shooting.length;
    shooting.scale = system.state_scale();
    // coordinates that move the probes by their noise, and the rates that do so within a radian
    shooting.gap = shooting.scale * (source.record.noise.mean() / shooting.length);
    shooting.gap.tail(n) = shooting.gap.head(n) * system.phase_rate();
    for (const ShootingWindow& window : shooting.windows) {
      const Vec guess = window.guess(shooting.offset * shooting.length);
      shooting.starts.push_back(guess.cwiseQuotient(shooting.scale));
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
        if (shooting.windows[w].has_next()) {
          blocks.push_back(shooting.starts[(w + 1) % shooting.starts.size()].data());
        }
        if (shooting.has_offset()) blocks.push_back(shooting.offset.data());
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
    iterations_ += static_cast<int>(summary.iterations.size());
    return summary;
  }

  /// The last solve. Where the model does not explain the records, steps shrink by nearly the same factor
  /// each, and hardly: after some of them what they sum up to is gone at once.
  ceres::Solver::Summary finish(double between, int most_iterations, double tolerance) {
    constexpr int before_leap = 15;
    const int begun = iterations_;
    for (;;) {
      const int left = most_iterations - (iterations_ - begun);
      auto summary = solve(between, std::min(before_leap, left), tolerance);
      const bool goes_on = summary.termination_type == ceres::NO_CONVERGENCE;
      if (!goes_on || left <= before_leap) return summary;
      leap(between);
    }
  }

  int iterations() const { return iterations_; }

  void hold_parameters() { problem_.SetParameterBlockConstant(search_.x.data()); }
  void free_parameters() { problem_.SetParameterBlockVariable(search_.x.data()); }

  /// Derivatives of all residuals, the parameters first, then unknown offsets; empty where a motion does
  /// not get through.
  Sparse jacobian() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks.push_back(search_.x.data());
    for (Shooting& shooting : search_.shootings) {
      if (shooting.has_offset()) options.parameter_blocks.push_back(shooting.offset.data());
    }
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
  /// All that is searched for, in its scales.
  std::vector<Eigen::Map<Vec>> unknowns() {
    const auto map = [](Vec& v) { return Eigen::Map<Vec>(v.data(), v.size()); };
    std::vector<Eigen::Map<Vec>> all{map(search_.x)};
    for (Shooting& shooting : search_.shootings) {
      if (shooting.has_offset()) all.push_back(map(shooting.offset));
      for (Vec& start : shooting.starts) all.push_back(map(start));
    }
    return all;
  }
  Vec place() {
    std::vector<double> all;
    for (const auto& one : unknowns()) all.insert(all.end(), one.begin(), one.end());
    return Vec::Map(all.data(), std::ssize(all));
  }
  /// @return  the sum of squares there; infinite outside of bounds, and where motions do not get through
  double go_to(const Vec& place) {
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

  /// From two steps b and c with c = q b nearly: c q / (1 - q) further on, or less where that is worse.
  void leap(double between) {
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

  Search& search_;
  ceres::Problem problem_;
  Interruption stop_;
  int iterations_ = 0;
};

/// What is left, and what the motions that were found read.
void add_residuals(Fit& fit, const Search& search) {
  double squares = 0.0, logarithms = 0.0;
  for (const Shooting& shooting : search.shootings) {
    const FitRecord& record = shooting.source->record;
    FitResidual left{.record = record.name,
                     .of_probe = Vec(record.readings.rows()),
                     .predicted = Mat(record.readings.rows(), record.readings.cols()),
                     .offset = shooting.offset * shooting.length,
                     .offset_deviation = {}};
    for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
      const ShootingWindow& window = shooting.windows[w];
      const Vec start = shooting.starts[w].cwiseProduct(shooting.scale);
      const Mat read = window.predict(*shooting.system, start);
      left.predicted.middleCols(window.first_sample(), read.cols()) = read.colwise() + left.offset;
    }
    const Mat off = left.predicted - record.readings;
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

/// The parameters with their errors, and those of offsets.
void add_errors(Fit& fit, const Search& search, const Sparse& J) {
  const Vec values = search.values();
  std::vector<bool> is_held;
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    const FreeParameter& parameter = search.parameters[static_cast<std::size_t>(p)];
    const double near = 1e-9 * parameter.size;
    is_held.push_back(values(p) - parameter.lower < near || parameter.upper - values(p) < near);
  }
  for (const Shooting& shooting : search.shootings) {
    if (shooting.has_offset()) is_held.resize(is_held.size() + shooting.offset.size(), false);
  }
  Mat C = fit_covariance(J, is_held);
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
  const Vec per = deviation.head(values.size()).cwiseInverse();
  fit.correlation = per.asDiagonal() * C.topLeftCorner(per.size(), per.size()) * per.asDiagonal();
  Eigen::Index at = values.size();
  for (std::size_t s = 0; s < search.shootings.size(); ++s) {
    const Shooting& shooting = search.shootings[s];
    Vec& off = fit.records[s].offset_deviation = Vec::Zero(shooting.offset.size());
    if (!shooting.has_offset()) continue;
    off = deviation.segment(at, off.size()) * shooting.length;
    at += off.size();
  }
}

/// One search.
Fit fit_from(Search& search, const FitOptions& options) {
  LeastSquares squares(search);
  Fit fit;
  squares.hold_parameters();
  squares.solve(gaps[0], 10, 1e-2);
  squares.free_parameters();
  std::vector<double> stages(gaps.begin(), gaps.end());
  if (search.has_steady()) stages.insert(stages.end(), closing.begin(), closing.end());
  long done = 0;
  const double enough = last_change / static_cast<double>(search.readings());
  for (const double between : stages) {
    const bool is_last = between == stages.back();
    const auto summary = is_last ? squares.finish(between, options.most_iterations, enough)
                                 : squares.solve(between, rough_iterations, rough_change);
    fit.iterations = squares.iterations();
    fit.has_converged = summary.termination_type == ceres::CONVERGENCE;
    if (!fit.has_converged) fit.why_not = summary.message;
    if (!fit.has_converged && summary.termination_type != ceres::NO_CONVERGENCE) break;
    if (options.progress) options.progress(++done, std::ssize(stages));
  }
  search.make_systems();
  add_residuals(fit, search);
  add_errors(fit, search, squares.jacobian());
  if (!fit.has_converged) return fit;
  fit.why_not.clear();
  const double most =
      std::sqrt(1.0 + improbable * std::sqrt(2.0 / static_cast<double>(fit.readings)));
  if (options.is_noise_known && fit.residual > most) {
    fit.has_converged = false;
    fit.why_not = fmt::format(
        "what is left is {:.4g} times the noise: the model does not explain the records, or "
        "another start finds more",
        fit.residual);
  }
  return fit;
}

}  // namespace

Fit fit(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& parameters,
        const FitOptions& options) {
  require_fit(sources, parameters);
  Fit best;
  for (const int windows : steady_windows) {
    Search search(sources, parameters, options, windows);
    Fit found = fit_from(search, options);
    if (windows == steady_windows[0] || found.has_converged || found.residual < best.residual) {
      best = std::move(found);
    }
    const bool is_stopped = options.is_stopped && options.is_stopped();
    const bool has_choice = search.has_steady() && options.window == 0.0;
    if (best.has_converged || !has_choice || is_stopped) break;
  }
  return best;
}

}  // namespace whirl::inline dyn
