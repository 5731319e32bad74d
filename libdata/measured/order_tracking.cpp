#include "libdata/measured/order_tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline data {

namespace {

constexpr double samples_per_unknown = 2.0;  ///< that a point has at least

/// Angles of the rotor at the samples between the first pulse and the last.
struct TurnedSamples {
  Eigen::Index first = 0;  ///< number of the first one in the record
  Vec angle;               ///< [rad]
};

TurnedSamples turned_samples(const ProbeReadings& readings) {
  const TurnClock& clock = *readings.clock;
  const auto sample = [&](double t) { return (t - readings.start) * readings.rate; };
  TurnedSamples turned{static_cast<Eigen::Index>(std::ceil(sample(clock.first()) - 1e-9)), {}};
  const auto last = static_cast<Eigen::Index>(std::floor(sample(clock.last()) + 1e-9));
  turned.angle.resize(std::max<Eigen::Index>(0, last - turned.first + 1));
  for (Eigen::Index j = 0; j < turned.angle.size(); ++j) {
    turned.angle(j) = clock.angle(readings.time(turned.first + j));
  }
  return turned;
}

/// What makes a constant and orders of weighted readings, unknowns x samples.
class OrderFit {
 public:
  /// @param middle  angle of the middle of the point
  /// @param width   of the window [rad]
  OrderFit(const Vec& angle, double middle, double width, const std::vector<double>& orders)
      : weighted_(angle.size(), 1 + 2 * std::ssize(orders)) {
    for (Eigen::Index j = 0; j < angle.size(); ++j) {
      // its square is the window
      const double weight = std::cos(0.5 * turn * (angle(j) - middle) / width);
      weighted_(j, 0) = weight;
      for (std::size_t q = 0; q < orders.size(); ++q) {
        const auto column = static_cast<Eigen::Index>(1 + 2 * q);
        weighted_(j, column) = weight * std::cos(orders[q] * angle(j));
        weighted_(j, column + 1) = -weight * std::sin(orders[q] * angle(j));
      }
    }
    weights_ = weighted_.col(0);
  }

  /// The constant, then real and imaginary parts of each order, a column per reading.
  Mat of(const Mat& readings) const {
    const Mat normal = weighted_.transpose() * weighted_;
    return DenseLu<Mat>(normal).solve(weighted_.transpose() *
                                      Mat(weights_.asDiagonal() * readings));
  }

 private:
  Mat weighted_;
  Vec weights_;
};

}  // namespace

OrderTracking track_orders(const ProbeReadings& readings, const OrderOptions& options) {
  const TurnedSamples turned = turned_samples(readings);
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
  const auto points = static_cast<Eigen::Index>(2.0 * turned_by / width) - 1;
  tracking.time.resize(points);
  tracking.speed.resize(points);
  for (const Probe& probe : readings.probes) {
    for (const double order : options.orders) {
      tracking.curves.push_back({probe, order, CVec(points)});
    }
  }
  const double* angles = turned.angle.data();
  for (Eigen::Index k = 0; k < points; ++k) {
    const double begin = turned.angle(0) + 0.5 * width * static_cast<double>(k);
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
    // the time at which the rotor is at the middle's angle
    const Eigen::Index at = std::lower_bound(angles, angles + n, begin + 0.5 * width) - angles;
    tracking.time(k) = readings.time(turned.first + at);
    tracking.speed(k) = readings.clock->speed(tracking.time(k));
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
  return tracking;
}

}  // namespace whirl::inline data
