#include "libdyn/taylor/motion_slopes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/system/number_slopes.hpp"
#include "libdyn/taylor/slope_run.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::size_t columns_of_pass = 8;  ///< Sloped::columns

/// What the systems of a pass have in common.
Pattern pattern_of(const ContactSystem& system, std::span<const SlopeColumn> columns) {
  std::vector<const ContactSystem*> all{&system};
  for (const SlopeColumn& c : columns) {
    if (!c.parameter) continue;
    for (const ContactSystem& s : c.parameter->neighbors) all.push_back(&s);
  }
  return Pattern::of(all);
}

/// Moves the columns of a pass to where all columns are.
///
/// @param slopes        of the pass, one or several of the same columns
/// @param by_start      as many; none: they are not wanted
/// @param by_parameter  as many
void put(const std::vector<Mat>& slopes, const SlopeRun& run, std::size_t first,
         std::vector<Mat>& by_start, std::vector<Mat>& by_parameter) {
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    for (std::size_t c = 0; c < run.columns.size(); ++c) {
      const auto column = slopes[k].col(static_cast<Eigen::Index>(c));
      const SlopeColumn& what = run.columns[c];
      if (!what.parameter) {
        by_start[k].col(what.start) = column;
        continue;
      }
      const Eigen::Index states = by_start.empty() ? 0 : by_start[k].cols();
      const auto number = static_cast<Eigen::Index>(first + c) - states;
      by_parameter[k].col(number) = column / what.parameter->step;
    }
  }
}

/// Two go side by side.
Mat in_pairs(const Mat& deviations) {
  Mat even = Mat::Zero(deviations.rows(), deviations.cols() + deviations.cols() % 2);
  even.leftCols(deviations.cols()) = deviations;
  return even;
}

}  // namespace

MotionSlopes motion_slopes(const ContactSystem& system, const MotionState& start,
                           std::span<const double> times, std::span<const SystemSlope> parameters,
                           const SlopeOptions& options) {
  assert(std::is_sorted(times.begin(), times.end()) && (times.empty() || times.front() >= 0.0));
  std::vector<SlopeColumn> columns;
  for (int i = 0; options.by_start && i < system.size(); ++i) columns.push_back({.start = i});
  for (const SystemSlope& p : parameters) {
    require_smooth(system, p);
    columns.push_back({.parameter = &p});
  }

  MotionSlopes result;
  result.end = start;
  if (times.empty()) return result;
  const long revolutions = static_cast<long>(std::ceil(times.back() / system.period())) + 2;
  const double fastest = fastest_mode(system);
  std::size_t first = 0;
  do {  // without columns, the motion alone
    const std::size_t count = std::min(columns_of_pass, columns.size() - first);
    SlopeRun run{.columns = {columns.begin() + static_cast<long>(first),
                             columns.begin() + static_cast<long>(first + count)},
                 .times = times,
                 .held = options.held,
                 .near = options.near,
                 .fastest = fastest,
                 .deviations = in_pairs(options.deviations)};
    Trajectory t{.system = &system, .state = start, .revolutions = revolutions};
    run_slopes(pattern_of(system, run.columns),
               {.tolerance = options.tolerance, .order = options.order}, t, run);
    if (first == 0) {
      const auto samples = static_cast<Eigen::Index>(run.states.size());
      result.states.resize(system.size(), samples);
      for (Eigen::Index k = 0; k < samples; ++k) {
        result.states.col(k) = run.states[static_cast<std::size_t>(k)];
      }
      const Mat none = Mat::Zero(system.size(), static_cast<Eigen::Index>(parameters.size()));
      result.by_parameter.assign(run.states.size(), none);
      if (options.by_start) {
        const Mat square = Mat::Zero(system.size(), system.size());
        result.by_start.assign(run.states.size(), square);
        result.deviations_by_start.assign(run.deviation_slopes.size(), square);
      }
      result.deviations_by_parameter.assign(run.deviation_slopes.size(), none);
      result.deviations = run.deviations.leftCols(options.deviations.cols());
      if (!run.states.empty()) result.end = std::move(run.end);
      const auto is_later = [&](const auto& what) { return what.time > times.back(); };
      std::erase_if(run.events, is_later);
      std::erase_if(run.grazes, is_later);
      result.events = std::move(run.events);
      result.grazes = std::move(run.grazes);
      result.outcome = t.outcome;
      result.failure = std::move(t.failure);
      result.cost = t.cost;
    }
    put(run.slopes, run, first, result.by_start, result.by_parameter);
    put(run.deviation_slopes, run, first, result.deviations_by_start,
        result.deviations_by_parameter);
    first += count;
  } while (first < columns.size());
  const auto count = static_cast<std::size_t>(options.deviations.cols());  // one may be too many
  for (auto* slopes : {&result.deviations_by_start, &result.deviations_by_parameter}) {
    if (slopes->size() > count) slopes->resize(count);
  }
  return result;
}

}  // namespace whirl::inline dyn
