#include "libdata/fit/fit.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdata/fit/fit_covariance.hpp"
#include "libdata/fit/fit_least_squares.hpp"
#include "libdata/fit/fit_search.hpp"

namespace whirl::inline data {

namespace {

/// What may be left between windows, in noises: at first it hardly counts, at last it has to be
/// nothing.
constexpr std::array<double, 9> gaps{100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01};
/// And then of steady motions, which close: what a gap lets through of a motion that does not seems
/// to tell parameters that the steady one does not (as the stiffness in a full annular rub). Of
/// other motions, too, while parameters are told less surely than their readings could tell them.
constexpr std::array<double, 2> closing{1e-3, 1e-4};
constexpr double nearly_least =
    1.01;  ///< standard deviation over the least one, which is near enough
constexpr int rough_iterations = 60;  ///< of all but the last of these
/// Change of the sum of squares in an iteration that ends one of them.
constexpr double rough_change = 1e-4;
/// Change in an iteration that ends the search, in mean squares of a reading: parameters move by a
/// hundredth of their deviations then.
constexpr double last_change = 1e-4;
/// Windows a revolution of a steady motion: a period is little to guess states from, and the
/// shorter windows are the nearer they follow it whatever the parameters are. Where the first
/// number leads nowhere the others may.
constexpr std::array<int, 3> steady_windows{8, 16, 4};
constexpr double confidence = 1.959963985;  ///< standard deviations to either side of 95 %

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

/// What is left, and what the motions that were found read.
void add_residuals(Fit& fit, const FitSearch& search) {
  double squares = 0.0, logarithms = 0.0;
  for (const RecordShooting& shooting : search.shootings) {
    const FitRecord& record = shooting.source->record;
    FitResidual left{.record = record.name,
                     .of_probe = Vec(record.readings.rows()),
                     .start = {},
                     .predicted = Mat(record.readings.rows(), record.readings.cols()),
                     .offset = shooting.offset * shooting.length,
                     .offset_deviation = {}};
    for (std::size_t w = 0; w < shooting.windows.size(); ++w) {
      const ShootingWindow& window = shooting.windows[w];
      const Vec start = shooting.starts[w].cwiseProduct(shooting.scale);
      if (w == 0) left.start = window.state(shooting.system->system, start);
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

/// Of the parameters, then of unknown offsets: whether a bound holds them.
std::vector<bool> held_unknowns(const FitSearch& search) {
  const Vec values = search.values();
  std::vector<bool> is_held;
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    const FreeParameter& parameter = search.parameters[static_cast<std::size_t>(p)];
    const double near = 1e-9 * parameter.size;
    is_held.push_back(values(p) - parameter.lower < near || parameter.upper - values(p) < near);
  }
  for (const RecordShooting& shooting : search.shootings) {
    if (shooting.has_offset()) is_held.resize(is_held.size() + shooting.offset.size(), false);
  }
  return is_held;
}

/// Largest standard deviation of a parameter over the least that it could have; 1 where none is
/// told.
double over_least_deviation(const FitSearch& search, const FitJacobian& J) {
  const std::vector<bool> is_held = held_unknowns(search);
  const Vec own = fit_covariance(J, FitGaps::residuals, is_held).diagonal();
  const Vec least = fit_covariance(J, FitGaps::constraints, is_held).diagonal();
  double largest = 1.0;
  for (Eigen::Index p = 0; p < search.x.size(); ++p) {
    if (std::isfinite(own(p)) && least(p) > 0.0) {
      largest = std::max(largest, std::sqrt(own(p) / least(p)));
    }
  }
  return largest;
}

/// The parameters with their errors, and those of offsets.
void add_errors(Fit& fit, const FitSearch& search, const FitJacobian& J) {
  const Vec values = search.values();
  const std::vector<bool> is_held = held_unknowns(search);
  Mat C = fit_covariance(J, FitGaps::residuals, is_held);
  fit.over_least_deviation = over_least_deviation(search, J);
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
    const RecordShooting& shooting = search.shootings[s];
    Vec& off = fit.records[s].offset_deviation = Vec::Zero(shooting.offset.size());
    if (!shooting.has_offset()) continue;
    off = deviation.segment(at, off.size()) * shooting.length;
    at += off.size();
  }
}

/// Why a search has not ended at a fit.
std::string why_not_of(DoglegEnd end, int iterations) {
  switch (end) {
    case DoglegEnd::converged:
      return "";
    case DoglegEnd::most_iterations:
      return fmt::format(
          "the search still moves after {} iterations: the model may not explain the records",
          iterations);
    case DoglegEnd::stopped:
      return fmt::format("it was stopped after {} iterations", iterations);
    case DoglegEnd::undefined:
      break;
  }
  return fmt::format("motions fail at all values that the search tries after {} iterations",
                     iterations);
}

/// Narrows the gaps of a search that has converged until the records tell parameters as surely as
/// they can. Where a narrower one is not found the search stays at the last, as motions do that
/// forget their beginning: no search follows these over a whole record.
void close_gaps(FitLeastSquares& squares, FitSearch& search, double enough) {
  for (const double between : closing) {
    if (over_least_deviation(search, squares.jacobian()) < nearly_least) return;
    const Vec place = squares.place();
    const double before = search.between;
    if (squares.finish(between, rough_iterations, enough).end == DoglegEnd::converged) continue;
    squares.go_to(place);
    search.between = before;
    return;
  }
}

/// One search.
Fit fit_from(FitSearch& search, const FitOptions& options) {
  FitLeastSquares squares(search);
  Fit fit;
  const auto find_states = [&] {
    squares.hold_parameters();
    squares.solve(gaps[0], 10, 1e-2);
    squares.free_parameters();
  };
  find_states();
  if (squares.rouse()) find_states();
  std::vector<double> stages(gaps.begin(), gaps.end());
  if (search.has_steady()) stages.insert(stages.end(), closing.begin(), closing.end());
  long done = 0;
  const double enough = last_change / static_cast<double>(search.readings());
  for (const double between : stages) {
    const bool is_last = between == stages.back();
    const auto found = is_last ? squares.finish(between, options.most_iterations, enough)
                               : squares.solve(between, rough_iterations, rough_change);
    fit.has_converged = found.end == DoglegEnd::converged;
    fit.why_not = why_not_of(found.end, squares.iterations());
    if (!fit.has_converged && found.end != DoglegEnd::most_iterations) break;
    if (options.progress) options.progress(++done, std::ssize(stages));
  }
  if (fit.has_converged && !search.has_steady()) close_gaps(squares, search, enough);
  fit.iterations = squares.iterations();
  search.make_systems();
  add_residuals(fit, search);
  add_errors(fit, search, squares.jacobian());
  if (!fit.has_converged) return fit;
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
    FitSearch search(sources, parameters, options, windows);
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

}  // namespace whirl::inline data
