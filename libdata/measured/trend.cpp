#include "libdata/measured/trend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libdata/measured/order_fit.hpp"
#include "libdata/measured/turned_samples.hpp"

namespace whirl::inline data {

namespace {

constexpr double most_frequency = 1000.0 * hertz, least_frequency = 10.0 * hertz,
                 least_of_slow = 2.0 * hertz, slow = 600.0 * rpm;
constexpr double window_power = 1.5;  ///< of a Hann window whose mean is one: sum of three lines

/// Times of revolutions, and the clock that has them.
TurnClock clock_of(const ProbeReadings& readings, double speed) {
  if (readings.clock) return *readings.clock;
  if (!(speed > 0.0)) throw OptionError("a trend needs a key-phasor or a speed");
  const double end = readings.time(readings.displacement.rows() - 1);
  std::vector<double> turns;
  for (int k = 0; readings.start + k * turn / speed <= end + 1e-9; ++k) {
    turns.push_back(readings.start + k * turn / speed);
  }
  std::vector<std::string> notes;
  return TurnClock(std::move(turns), {}, notes);
}

double velocity_of(const Vec& reading, double rate, double speed) {
  const auto n = static_cast<Eigen::Index>(smooth_length(static_cast<long>(reading.size())));
  const Vec used = reading.tail(n).array() - reading.tail(n).mean();
  const Spectrum s = hann_spectrum(used.cast<Complex>(), 1.0 / rate);
  const double least = speed < slow ? least_of_slow : least_frequency;
  double square = 0.0;
  for (Eigen::Index k = 1; 2 * k < n; ++k) {
    const double w = static_cast<double>(k) * s.bin;
    if (w < least || w > most_frequency) continue;
    square += 2.0 * w * w * std::norm(s.at(k)) / window_power;  // a cosine is two lines of half
  }
  return std::sqrt(square);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(const Vec& values) {
  return median(std::vector<double>(values.begin(), values.end()));
}

}  // namespace

Trend trend_of(const ProbeReadings& readings, const TrendOptions& options) {
  const TurnClock clock = clock_of(readings, options.speed);
  const auto [first, angle] = turned_samples(readings, clock);
  const double all = angle.size() > 0 ? (angle(angle.size() - 1) - angle(0)) / turn : 0.0;
  if (all < options.revolutions) {
    throw OptionError(
        fmt::format("the record has {:.3g} revolutions, a point of a trend takes {:g}", all,
                    options.revolutions));
  }
  const double each =
      options.revolutions *
      std::ceil(all / options.revolutions / static_cast<double>(options.most) - 1e-9);
  const auto points = static_cast<Eigen::Index>(all / each + 1e-9);
  Trend trend{{}, Vec(points), Vec(points), {}, {}};
  for (const Probe& probe : readings.probes) {
    trend.probes.push_back({probe, Vec(points), Vec(points), CVec(points), Vec(points)});
  }
  const double* angles = angle.data();
  for (Eigen::Index k = 0; k < points; ++k) {
    const double begin = angle(0) + turn * each * static_cast<double>(k), width = turn * each;
    const Eigen::Index from = std::lower_bound(angles, angles + angle.size(), begin) - angles;
    const Eigen::Index count =
        std::lower_bound(angles, angles + angle.size(), begin + width) - angles - from;
    if (count < 8) throw OptionError("the record has too few samples per revolution for a trend");
    const Mat part = readings.displacement.middleRows(first + from, count);
    const Mat found =
        OrderFit(angle.segment(from, count), begin + 0.5 * width, width, {1.0}).of(part);
    const double middle = readings.time(first + from + count / 2);
    trend.number.push_back(static_cast<double>(k + 1));
    trend.time(k) = middle;
    trend.speed(k) = clock.speed(std::clamp(middle, clock.first(), clock.last()));
    for (std::size_t i = 0; i < trend.probes.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      TrendCurve& curve = trend.probes[i];
      curve.gap(k) = found(0, c);
      curve.overall(k) = part.col(c).maxCoeff() - part.col(c).minCoeff();
      curve.first(k) = {found(1, c), found(2, c)};
      curve.velocity(k) = velocity_of(part.col(c), readings.rate, trend.speed(k));
    }
  }
  return trend;
}

Trend trend_of_records(const std::vector<Trend>& records, const std::vector<std::string>& names) {
  const auto count = std::ssize(records);
  Trend trend{{}, Vec::Constant(count, nan), Vec(count), names, {}};
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Trend& one = records[r];
    const auto k = static_cast<Eigen::Index>(r);
    trend.number.push_back(static_cast<double>(r + 1));
    trend.speed(k) = median(one.speed);
    for (std::size_t i = 0; i < one.probes.size(); ++i) {
      const TrendCurve& from = one.probes[i];
      if (r == 0) {
        trend.probes.push_back({from, Vec(count), Vec(count), CVec(count), Vec(count)});
      } else if (one.probes.size() != trend.probes.size() || trend.probes[i].name != from.name) {
        throw OptionError(fmt::format("{} has other probes than {}", names[r], names[0]));
      }
      TrendCurve& to = trend.probes[i];
      to.gap(k) = median(from.gap);
      to.overall(k) = median(from.overall);
      to.first(k) = from.first.mean();
      to.velocity(k) = median(from.velocity);
    }
  }
  return trend;
}

}  // namespace whirl::inline data
