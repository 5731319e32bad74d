#include "libdata/fit/shooting_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libdata/fit/fit_runout.hpp"
#include "libdyn/taylor/motion_slopes.hpp"

namespace whirl::inline data {

namespace {

constexpr double tolerance = 1e-10;  ///< of motions that are compared with noise

/// A steady motion needs readings all around, and cannot repeat before its loads do.
void require_period(const FitRecord& record, const ContactSystem& system) {
  const double lasts = record.times(record.times.size() - 1) - record.times(0);
  const double period = record.period * system.period();
  if (!(lasts > 0.5 * period && lasts < period)) {
    throw ModelError({}, record.name,
                     fmt::format("is to be one period of a steady motion, {:.6g} s, but its "
                                 "readings last {:.6g} s: average them first (steady_record)",
                                 period, lasts));
  }
  const long loads = system.repeats_after();
  if (loads > 0 && record.period % loads == 0) return;
  throw ModelError(
      {}, record.name,
      fmt::format("is to repeat after {} revolutions, but the loads of the model do so "
                  "{}",
                  record.period, loads > 0 ? fmt::format("after {}", loads) : "never"));
}

}  // namespace

ShootingWindow::ShootingWindow(const FitSource& source, Eigen::Index first, Eigen::Index samples,
                               std::optional<double> end)
    : source_(&source), first_(first), samples_(samples), has_next_(end.has_value()) {
  const FitRecord& record = source.record;
  for (Eigen::Index i = 0; i < samples; ++i) {
    times_.push_back(record.times(first + i) - record.times(first));
  }
  if (end) times_.push_back(*end - record.times(first));
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
      if (std::isfinite(record.readings(probe, first + i))) read_.push_back({probe, i});
    }
  }
}

Vec ShootingWindow::guess(const Vec& offset) const {
  constexpr Eigen::Index most_samples = 9;
  const FitRecord& record = source_->record;
  const Eigen::Index probes = source_->rows.rows();
  const Eigen::Index used =
      std::min({std::ssize(times_), record.times.size() - first_, most_samples});
  Vec reading = Vec::Zero(probes), rate = Vec::Zero(probes);
  for (Eigen::Index probe = 0; probe < probes; ++probe) {  // a parabola through its first samples
    std::vector<Eigen::Index> good;
    for (Eigen::Index i = 0; i < used; ++i) {
      if (std::isfinite(record.readings(probe, first_ + i))) good.push_back(i);
    }
    Mat powers(std::ssize(good), 3);
    Vec values(std::ssize(good));
    for (std::size_t i = 0; i < good.size(); ++i) {
      const double t = times_[static_cast<std::size_t>(good[i])];
      const auto row = static_cast<Eigen::Index>(i);
      powers.row(row) << 1.0, t, t * t;
      values(row) = record.readings(probe, first_ + good[i]) - offset(probe);
    }
    if (good.empty()) continue;
    const Vec parabola = least_squares(powers, values);
    reading(probe) = parabola(0);
    rate(probe) = parabola(1);
  }
  const Mat& rows = source_->rows;  // the least coordinates that read so
  const Mat gram = rows * rows.transpose();
  Vec y(states());
  y << rows.transpose() * least_squares(gram, reading),
      rows.transpose() * least_squares(gram, rate);
  return y;
}

double ShootingWindow::angle(const ContactSystem& system, Eigen::Index sample) const {
  const FitRecord& record = source_->record;
  return record.phase + system.phase_rate() * (record.times(first_ + sample) - record.times(0));
}

MotionState ShootingWindow::state(const ContactSystem& system, const Vec& start) const {
  const double turned = angle(system, 0);
  const double revolution = std::floor(turned / (turn));
  MotionState state;
  state.revolution = static_cast<long>(revolution);
  state.phase = std::clamp(turned - turn * revolution, 0.0, std::nextafter(turn, 0.0));
  state.y = start;
  return state;
}

ShootingWindow::Comparison ShootingWindow::compare(const FitSystem& system, const Vec& start,
                                                   const Vec& offset, bool slopes) const {
  const FitRecord& record = source_->record;
  const Mat& rows = source_->rows;
  const StateLayout layout(rows.cols());
  const std::span<const SystemSlope> by =
      slopes ? std::span<const SystemSlope>(system.slopes) : std::span<const SystemSlope>();
  MotionSlopes motion;
  Comparison found;
  try {
    motion = motion_slopes(system.system, state(system.system, start), times_, by,
                           {.tolerance = tolerance, .by_start = slopes});
  } catch (const NumericalError&) {  // a parameter where it has no derivative
    return found;
  }
  if (motion.outcome != Outcome::reached_end) return found;
  found.is_good = true;
  found.grazes = std::ssize(motion.grazes);
  found.readings.resize(readings());
  if (slopes) {
    found.readings_by_start.resize(readings(), layout.size());
    const Eigen::Index unknowns = std::ssize(by) + system.runout.size();
    found.readings_by_parameter = Mat::Zero(readings(), unknowns);
    found.end_by_start = motion.by_start.back();
    found.end_by_parameter = Mat::Zero(layout.size(), unknowns);
    found.end_by_parameter.leftCols(std::ssize(by)) = motion.by_parameter.back();
  }
  found.end = motion.states.col(motion.states.cols() - 1);
  for (Eigen::Index r = 0; r < readings(); ++r) {
    const auto [probe, sample] = read_[static_cast<std::size_t>(r)];
    const double noise = record.noise(probe);
    const auto row = rows.row(probe);
    const double turned = angle(system.system, sample);
    const double reading = row.dot(layout.eta(motion.states).col(sample)) + offset(probe) +
                           runout_at(record, system.runout, probe, turned);
    found.readings(r) = (reading - record.readings(probe, first_ + sample)) / noise;
    if (!slopes) continue;
    const auto at = static_cast<std::size_t>(sample);
    found.readings_by_start.row(r) = row * layout.eta(motion.by_start[at]) / noise;
    auto by_parameter = found.readings_by_parameter.row(r);
    by_parameter.head(std::ssize(by)) = row * layout.eta(motion.by_parameter[at]) / noise;
    if (record.runout_orders == 0) continue;
    const Eigen::RowVectorXd functions = runout_functions(record, turned);
    by_parameter.segment(std::ssize(by) + first_runout(record, probe), functions.size()) =
        functions / noise;
  }
  return found;
}

Mat ShootingWindow::readings_by_offset() const {
  Mat by = Mat::Zero(readings(), source_->rows.rows());
  for (Eigen::Index r = 0; r < readings(); ++r) {
    const Eigen::Index probe = read_[static_cast<std::size_t>(r)].probe;
    by(r, probe) = 1.0 / source_->record.noise(probe);
  }
  return by;
}

Mat ShootingWindow::predict(const FitSystem& system, const Vec& start) const {
  const std::span<const double> times(times_.data(), static_cast<std::size_t>(samples_));
  const MotionSlopes motion = motion_slopes(system.system, state(system.system, start), times, {},
                                            {.tolerance = tolerance, .by_start = false});
  Mat read = Mat::Constant(source_->rows.rows(), samples_, std::nan(""));
  read.leftCols(motion.states.cols()) = source_->rows * motion.states.topRows(source_->rows.cols());
  for (Eigen::Index probe = 0; probe < read.rows(); ++probe) {
    for (Eigen::Index sample = 0; sample < read.cols(); ++sample) {
      read(probe, sample) +=
          runout_at(source_->record, system.runout, probe, angle(system.system, sample));
    }
  }
  return read;
}

std::vector<ShootingWindow> shooting_windows(const FitSource& source, double duration,
                                             const ContactSystem& system) {
  const FitRecord& record = source.record;
  const Vec& times = record.times;
  const Eigen::Index samples = times.size();
  const bool is_steady = record.period > 0;
  const double lasts = times(samples - 1) - times(0);
  const double whole = is_steady ? record.period * system.period() : lasts;
  if (is_steady) require_period(record, system);
  const auto count = std::max<Eigen::Index>(is_steady ? 2 : 1, std::lround(whole / duration));
  std::vector<ShootingWindow> windows;
  for (Eigen::Index first = 0, w = 1; w <= count && first < samples; ++w) {
    const double end = times(0) + whole * static_cast<double>(w) / static_cast<double>(count);
    Eigen::Index next = samples;
    if (w < count) {
      next = std::lower_bound(times.begin(), times.end(), end) - times.begin();
      if (next <= first) continue;
      if (!is_steady && next == samples - 1) next = samples;  // none begins where all ends
    }
    std::optional<double> until;
    if (next < samples) until = times(next);
    if (next == samples && is_steady) until = times(0) + whole;
    windows.emplace_back(source, first, next - first, until);
    first = next;
  }
  return windows;
}

}  // namespace whirl::inline data
