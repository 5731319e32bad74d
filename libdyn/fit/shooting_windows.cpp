#include "libdyn/fit/shooting_windows.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/constants.hpp"
#include "libbase/dense.hpp"
#include "libdyn/taylor/motion_slopes.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double tolerance = 1e-10;  ///< of motions that are compared with noise

}  // namespace

ShootingWindow::ShootingWindow(const FitSource& source, Eigen::Index first, Eigen::Index last,
                               bool is_last)
    : source_(&source), first_(first), last_(last), is_last_(is_last) {
  const FitRecord& record = source.record;
  for (Eigen::Index i = first; i <= last; ++i)
    times_.push_back(record.times(i) - record.times(first));
  const Eigen::Index samples = last - first + (is_last ? 1 : 0);
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (Eigen::Index probe = 0; probe < record.readings.rows(); ++probe) {
      if (std::isfinite(record.readings(probe, first + i))) read_.push_back({probe, i});
    }
  }
}

Vec ShootingWindow::guess() const {
  constexpr Eigen::Index most_samples = 9;
  const FitRecord& record = source_->record;
  const Eigen::Index probes = source_->rows.rows();
  const Eigen::Index used = std::min(last_ - first_ + 1, most_samples);
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
      values(row) = record.readings(probe, first_ + good[i]);
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

MotionState ShootingWindow::state(const ContactSystem& system, const Vec& start) const {
  const FitRecord& record = source_->record;
  const double turned =
      record.phase + system.phase_rate() * (record.times(first_) - record.times(0));
  const double revolution = std::floor(turned / (turn));
  MotionState state;
  state.revolution = static_cast<long>(revolution);
  state.phase = std::clamp(turned - turn * revolution, 0.0, std::nextafter(turn, 0.0));
  state.y = start;
  return state;
}

ShootingWindow::Comparison ShootingWindow::compare(const FitSystem& system, const Vec& start,
                                                   bool slopes) const {
  const FitRecord& record = source_->record;
  const Mat& rows = source_->rows;
  const Eigen::Index n = rows.cols();
  const std::span<const SystemSlope> by =
      slopes ? std::span<const SystemSlope>(system.slopes) : std::span<const SystemSlope>();
  const MotionSlopes motion = motion_slopes(system.system, state(system.system, start), times_, by,
                                            {.tolerance = tolerance, .by_start = slopes});
  Comparison found;
  if (motion.outcome != Outcome::reached_end) return found;
  found.is_good = true;
  found.grazes = std::ssize(motion.grazes);
  found.readings.resize(readings());
  if (slopes) {
    found.readings_by_start.resize(readings(), 2 * n);
    found.readings_by_parameter.resize(readings(), std::ssize(by));
    found.end_by_start = motion.by_start.back();
    found.end_by_parameter = motion.by_parameter.back();
  }
  found.end = motion.states.col(motion.states.cols() - 1);
  for (Eigen::Index r = 0; r < readings(); ++r) {
    const auto [probe, sample] = read_[static_cast<std::size_t>(r)];
    const double noise = record.noise(probe);
    const auto row = rows.row(probe);
    found.readings(r) =
        (row.dot(motion.states.col(sample).head(n)) - record.readings(probe, first_ + sample)) /
        noise;
    if (!slopes) continue;
    const auto at = static_cast<std::size_t>(sample);
    found.readings_by_start.row(r) = row * motion.by_start[at].topRows(n) / noise;
    found.readings_by_parameter.row(r) = row * motion.by_parameter[at].topRows(n) / noise;
  }
  return found;
}

Mat ShootingWindow::predict(const FitSystem& system, const Vec& start) const {
  const Eigen::Index samples = last_ - first_ + (is_last_ ? 1 : 0);
  const std::span<const double> times(times_.data(), static_cast<std::size_t>(samples));
  const MotionSlopes motion = motion_slopes(system.system, state(system.system, start), times, {},
                                            {.tolerance = tolerance, .by_start = false});
  Mat read = Mat::Constant(source_->rows.rows(), samples, std::nan(""));
  read.leftCols(motion.states.cols()) = source_->rows * motion.states.topRows(source_->rows.cols());
  return read;
}

std::vector<ShootingWindow> shooting_windows(const FitSource& source, double duration) {
  const Vec& times = source.record.times;
  const Eigen::Index last = times.size() - 1;
  std::vector<ShootingWindow> windows;
  const double whole = times(last) - times(0);
  const auto count = std::max<Eigen::Index>(1, std::lround(whole / duration));
  Eigen::Index first = 0;
  for (Eigen::Index w = 1; w <= count && first < last; ++w) {
    const double end = times(0) + whole * static_cast<double>(w) / static_cast<double>(count);
    Eigen::Index next = last;
    if (w < count) {
      next = std::lower_bound(times.begin(), times.end(), end) - times.begin();
      if (next <= first) continue;
    }
    windows.emplace_back(source, first, next, next == last);
    first = next;
  }
  return windows;
}

}  // namespace whirl::inline dyn
