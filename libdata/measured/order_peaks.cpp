#include "libdata/measured/order_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline data {

namespace {

constexpr double least_range = 0.1;   ///< of the speed, over which there can be peaks
constexpr double near_top = 0.95;     ///< of the largest point: its neighbors make the top
constexpr double least_share = 0.05;  ///< of the largest peak that counts
constexpr std::size_t most_peaks = 8;
constexpr double most_amplification = 500.0;  ///< of a mode with 0.1 % of critical damping
constexpr double most_above = 1.1;            ///< of the top over its largest point
constexpr double above_flanks = 6.0;  ///< deviations of the noise, by which a top is over flanks
constexpr std::ptrdiff_t least_between = 5;  ///< points, for a factor that is right to some percent

/// Points of a curve in ascending speed.
struct Curve {
  std::vector<double> speed, size;  ///< [rad/s], [m]
  std::vector<Complex> response;

  std::ptrdiff_t count() const { return std::ssize(speed); }
  double s(std::ptrdiff_t i) const { return speed[static_cast<std::size_t>(i)]; }
  double a(std::ptrdiff_t i) const { return size[static_cast<std::size_t>(i)]; }
};

Curve ascending(const Vec& speed, const CVec& response) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(speed.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return speed(i) < speed(j); });
  Curve curve;
  for (const Eigen::Index i : order) {
    curve.speed.push_back(speed(i));
    curve.response.push_back(response(i));
    curve.size.push_back(std::abs(response(i)));
  }
  return curve;
}

/// The top of the parabola for 1 / a^2 about a point that is larger than its neighbors.
void refine(const Curve& c, std::ptrdiff_t k, ResponsePeak& peak) {
  std::ptrdiff_t first = k, last = k;
  while (first > 0 && c.a(first - 1) > near_top * c.a(k)) --first;
  while (last + 1 < c.count() && c.a(last + 1) > near_top * c.a(k)) ++last;
  first = std::max<std::ptrdiff_t>(0, std::min(first, k - 1));
  last = std::min(c.count() - 1, std::max(last, k + 1));
  const double scale = std::max(c.s(k) - c.s(first), c.s(last) - c.s(k));
  if (last - first < 2 || !(scale > 0.0)) return;
  Mat powers(last - first + 1, 3);
  Vec inverse(last - first + 1);
  for (std::ptrdiff_t i = first; i <= last; ++i) {
    const double u = (c.s(i) - c.s(k)) / scale, ratio = c.a(k) / c.a(i);
    powers.row(i - first) << 1.0, u, u * u;
    inverse(i - first) = ratio * ratio;
  }
  const Mat normal = powers.transpose() * powers;
  const Vec b = DenseLu<Mat>(normal).solve(Mat(powers.transpose() * inverse));
  if (!(b(2) > 0.0)) return;
  const double top = -0.5 * b(1) / b(2), least = b(0) - 0.25 * b(1) * b(1) / b(2);
  if (std::abs(top) > 1.0 || !(least > 0.0)) return;
  if (least * most_above * most_above < 1.0) return;
  peak.speed = c.s(k) + scale * top;
  peak.amplitude = c.a(k) / std::sqrt(least);
}

/// Where a curve falls below a limit on one side; NaN if it does not.
/// @param largest  receives the largest point before that
double side(const Curve& c, std::ptrdiff_t k, std::ptrdiff_t step, double limit, double& largest) {
  for (std::ptrdiff_t i = k; i + step >= 0 && i + step < c.count(); i += step) {
    const double here = c.a(i), next = c.a(i + step);
    if (next <= limit) {
      const double share = (here - limit) / (here - next);
      return c.s(i) + share * (c.s(i + step) - c.s(i));
    }
    largest = std::max(largest, next);
  }
  return nan;
}

}  // namespace

std::vector<OrderPeak> order_peaks(const Vec& speed, const CVec& response, Eigen::Index curve,
                                   double noise) {
  if (speed.size() < 3 || speed.maxCoeff() - speed.minCoeff() < least_range * speed.maxCoeff()) {
    return {};
  }
  const Curve c = ascending(speed, response);
  const double highest = *std::max_element(c.size.begin(), c.size.end());
  const double least =
      std::max(least_share * highest, above_flanks * noise / (1.0 - 1.0 / std::numbers::sqrt2));
  std::vector<OrderPeak> peaks;
  for (std::ptrdiff_t k = 1; k + 1 < c.count(); ++k) {
    if (!(c.a(k) > c.a(k - 1) && c.a(k) >= c.a(k + 1) && c.a(k) > least)) continue;
    OrderPeak peak;
    peak.row = curve;
    peak.speed = c.s(k);
    peak.amplitude = c.a(k);
    refine(c, k, peak);
    const double limit = std::min(peak.amplitude, c.a(k)) / std::numbers::sqrt2;
    double largest = 0.0;
    peak.below = side(c, k, -1, limit, largest);
    peak.above = side(c, k, +1, limit, largest);
    const bool has_sides = std::isfinite(peak.below) && std::isfinite(peak.above);
    if (largest > c.a(k) || (!has_sides && c.a(k) < highest)) continue;
    const auto between = std::count_if(c.speed.begin(), c.speed.end(),
                                       [&](double s) { return s > peak.below && s < peak.above; });
    if (between < least_between && c.a(k) < highest) continue;
    // a motion that jumps has no half-power speeds
    const bool has_jumped = peak.amplification() > most_amplification;
    if (between < least_between || has_jumped) peak.below = peak.above = nan;
    peak.phase = std::arg(c.response[static_cast<std::size_t>(k)]);
    peaks.push_back(peak);
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const OrderPeak& a, const OrderPeak& b) {
    return a.amplitude > b.amplitude;
  });
  if (peaks.size() > most_peaks) peaks.resize(most_peaks);
  std::sort(peaks.begin(), peaks.end(),
            [](const OrderPeak& a, const OrderPeak& b) { return a.speed < b.speed; });
  return peaks;
}

}  // namespace whirl::inline data
