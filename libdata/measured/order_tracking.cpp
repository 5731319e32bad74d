#include "libdata/measured/order_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/statistics.hpp"
#include "libdata/measured/order_fit.hpp"
#include "libdata/measured/turned_samples.hpp"

namespace whirl::inline data {

namespace {

constexpr double samples_per_unknown = 2.0;  ///< that a point has at least

/// Revolutions from a point to the next.
/// @param all  revolutions of the record
double step_of(const ProbeReadings& readings, const OrderOptions& options, double all) {
  constexpr double run_up = 0.1;  // change of speed
  constexpr double most_points = 4000.0;
  if (options.step) return *options.step;
  const double half = 0.5 * options.revolutions;
  if (readings.clock->variation() < run_up) return half;
  return std::min(half, std::max(1.0, all / most_points));
}

/// When the rotor is at the middle of a point, and how fast.
struct Middle {
  double time, speed;
};

/// Both by the parabola of the angle over the revolutions about it: single pulses may be told as
/// late as a sample, and jump by that.
class SmoothClock {
 public:
  explicit SmoothClock(const TurnClock& clock) : turns_(clock.turns()) {
    for (const double t : turns_) angles_.push_back(clock.angle(t));
  }
  Middle at(double angle) const {
    constexpr std::ptrdiff_t half = 16;  // revolutions to either side
    const auto here = std::lower_bound(angles_.begin(), angles_.end(), angle) - angles_.begin();
    const auto first = std::max<std::ptrdiff_t>(0, here - half);
    const auto last = std::min(std::ssize(angles_), here + half);
    const double t0 = turns_[static_cast<std::size_t>(std::min(here, last - 1))];
    const double scale =
        turns_[static_cast<std::size_t>(last - 1)] - turns_[static_cast<std::size_t>(first)];
    Mat powers(last - first, 3);
    Vec turned(last - first);
    for (std::ptrdiff_t k = first; k < last; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double u = (turns_[i] - t0) / scale;
      powers.row(k - first) << 1.0, u, u * u;
      turned(k - first) = angles_[i] - angle;
    }
    const Vec b = least_squares(powers, turned);
    double u = -b(0) / b(1);
    for (int i = 0; i < 3; ++i) u = -b(0) / (b(1) + b(2) * u);
    return {t0 + scale * u, (b(1) + 2.0 * b(2) * u) / scale};
  }

 private:
  std::vector<double> turns_, angles_;
};

/// Standard deviation of the noise of a curve [m], by differences of points that have no revolution
/// in common; 0 where the curve is too short to tell noise from a resonance.
/// @param apart  points from one to the next such point
double noise_of(const CVec& response, Eigen::Index apart) {
  constexpr Eigen::Index fewest = 40;   // such distances in a curve
  constexpr double of_median = 1.1774;  // of the size of a complex number, over its deviation
  if (response.size() < fewest * apart) return 0.0;
  const Eigen::Index n = response.size() - 2 * apart;
  const CVec second = response.head(n) - 2.0 * response.segment(apart, n) + response.tail(n);
  const Vec sizes = second.cwiseAbs();
  // of real and imaginary part: 1 + 4 + 1 times the variance of a point
  return median_of({sizes.begin(), sizes.end()}) / (of_median * std::sqrt(6.0));
}

}  // namespace

OrderTracking track_orders(const ProbeReadings& readings, const OrderOptions& options) {
  const TurnedSamples turned = turned_samples(readings, *readings.clock);
  const double width = turn * options.revolutions;
  const Eigen::Index n = turned.angle.size();
  const double turned_by = n > 0 ? turned.angle(n - 1) - turned.angle(0) : 0.0;
  if (turned_by < width) {
    throw OptionError(
        fmt::format("the key-phasor saw {:.3g} revolutions, a point of the orders takes "
                    "{:g}",
                    turned_by / turn, options.revolutions));
  }
  OrderTracking tracking;
  const double step = turn * step_of(readings, options, turned_by / turn);
  const auto points = static_cast<Eigen::Index>((turned_by - width) / step + 1e-9) + 1;
  tracking.time.resize(points);
  tracking.speed.resize(points);
  for (const Probe& probe : readings.probes) {
    for (const double order : options.orders) {
      tracking.curves.push_back({probe, order, CVec(points)});
    }
  }
  const double* angles = turned.angle.data();
  const SmoothClock clock(*readings.clock);
  for (Eigen::Index k = 0; k < points; ++k) {
    const double begin = turned.angle(0) + step * static_cast<double>(k);
    const Eigen::Index from = std::lower_bound(angles, angles + n, begin) - angles;
    const Eigen::Index to = std::lower_bound(angles, angles + n, begin + width) - angles;
    const Vec angle = turned.angle.segment(from, to - from);
    const double unknowns = 1.0 + 2.0 * static_cast<double>(options.orders.size());
    const double highest = *std::max_element(options.orders.begin(), options.orders.end());
    const double needed = std::max(samples_per_unknown * unknowns, 2.0 * highest * width / turn);
    if (static_cast<double>(angle.size()) <= needed) {
      throw OptionError(fmt::format("{} samples in {:g} revolutions are too few for order {:g}",
                                    angle.size(), options.revolutions, highest));
    }
    const Mat found = OrderFit(angle, begin + 0.5 * width, width, options.orders)
                          .of(readings.displacement.middleRows(turned.first + from, to - from));
    for (std::size_t c = 0; c < tracking.curves.size(); ++c) {
      const auto probe = static_cast<Eigen::Index>(c / options.orders.size());
      const auto row = static_cast<Eigen::Index>(1 + 2 * (c % options.orders.size()));
      tracking.curves[c].response(k) = {found(row, probe), found(row + 1, probe)};
    }
    const Middle middle = clock.at(begin + 0.5 * width);
    tracking.time(k) = middle.time;
    tracking.speed(k) = middle.speed;
  }
  if (options.slow_roll) {
    Eigen::Index nearest = 0;
    (tracking.speed.array() - *options.slow_roll).abs().minCoeff(&nearest);
    tracking.slow_roll = tracking.speed(nearest);
    for (OrderCurve& curve : tracking.curves) {
      const Complex runout = curve.response(nearest);
      curve.response.array() -= runout;
    }
  }
  const auto apart = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(width / step)));
  for (std::size_t c = 0; c < tracking.curves.size(); ++c) {
    const CVec& response = tracking.curves[c].response;
    for (const OrderPeak& peak : order_peaks(tracking.speed, response, static_cast<Eigen::Index>(c),
                                             noise_of(response, apart))) {
      tracking.peaks.push_back(peak);
    }
  }
  return tracking;
}

}  // namespace whirl::inline data
