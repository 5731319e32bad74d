#include "libdata/measured/orbit_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/band_filter.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libdata/measured/order_fit.hpp"

namespace whirl::inline data {

namespace {

constexpr double most_harmonics = 32.0;
constexpr Eigen::Index points_of_orbit = 240;  ///< of orders and averages
constexpr double same_speed = 0.01;            ///< that a steady motion may be asked for by

/// Samples about a moment, with the angle of the rotor.
struct Stretch {
  Eigen::Index first = 0;
  Vec angle;           ///< [rad]
  double begin = 0.0;  ///< angle at which it begins [rad]
  double width = 0.0;  ///< angle that it goes on for [rad]

  Eigen::Index size() const { return angle.size(); }
  double revolutions() const { return width / turn; }
};

/// Numbers of the samples between two times.
std::pair<Eigen::Index, Eigen::Index> samples_between(const Vec& time, double from, double to) {
  const double* t = time.data();
  const auto first = std::lower_bound(t, t + time.size(), from) - t;
  return {first, (std::upper_bound(t + first, t + time.size(), to) - t) - first};
}

Stretch stretch_about(const TurnedMotion& motion, double at, double revolutions) {
  const TurnClock& clock = motion.clock;
  const double begin = std::max(clock.first(), motion.time(0));
  const double end = std::min(clock.last(), motion.time(motion.time.size() - 1));
  if (!(at >= motion.time(0) && at <= motion.time(motion.time.size() - 1))) {
    throw OptionError(
        fmt::format("{:.6g} s is not within the motion, which goes from {:.6g} to "
                    "{:.6g} s",
                    at, motion.time(0), motion.time(motion.time.size() - 1)));
  }
  const double first = clock.angle(begin), last = clock.angle(end);
  Stretch s;
  s.width = turn * std::min(revolutions, std::floor((last - first) / turn + 1e-9));
  if (!(s.width > 0.0)) throw OptionError("the motion has less than one revolution");
  const double middle = clock.angle(std::clamp(at, begin, end));
  s.begin = std::clamp(middle - 0.5 * s.width, first, std::max(first, last - s.width));
  const auto [from, count] = samples_between(motion.time, begin, end);
  // angles ascend with time
  const auto place = [&, from = from, count = count](double angle) {
    Eigen::Index low = from, high = from + count;
    while (low < high) {
      const Eigen::Index middle_of = low + (high - low) / 2;
      (clock.angle(motion.time(middle_of)) < angle ? low = middle_of + 1 : high = middle_of);
    }
    return low;
  };
  constexpr double rounding = 1e-9;  // [rad]
  s.first = place(s.begin - rounding);
  const Eigen::Index behind = place(s.begin + s.width - rounding);
  s.angle.resize(behind - s.first);
  for (Eigen::Index j = 0; j < s.angle.size(); ++j) {
    s.angle(j) = clock.angle(motion.time(s.first + j));
  }
  return s;
}

/// Orders of x and y of a stretch.
struct StationOrders {
  std::vector<double> orders;
  Complex mean;
  CVec x, y;  ///< per order [m]

  Complex at(double angle) const {
    Complex z;
    for (Eigen::Index q = 0; q < x.size(); ++q) {
      const Complex e = std::polar(1.0, orders[static_cast<std::size_t>(q)] * angle);
      z += Complex((x(q) * e).real(), (y(q) * e).real());
    }
    return z;
  }
};

StationOrders orders_of(const StationMotion& station, const Stretch& s,
                        std::vector<double> orders) {
  if (s.revolutions() < fewest_orbit_revolutions) {
    throw OptionError(
        fmt::format("an order or an average takes {:g} revolutions or more, found {:g}",
                    fewest_orbit_revolutions, s.revolutions()));
  }
  const double highest = *std::max_element(orders.begin(), orders.end());
  if (static_cast<double>(s.size()) <= 2.0 * highest * s.revolutions()) {
    throw OptionError(fmt::format("{} samples in {:g} revolutions are too few for order {:g}",
                                  s.size(), s.revolutions(), highest));
  }
  Mat readings(s.size(), 2);
  readings << station.x.segment(s.first, s.size()), station.y.segment(s.first, s.size());
  const Mat found = OrderFit(s.angle, s.begin + 0.5 * s.width, s.width, orders).of(readings);
  StationOrders result{std::move(orders), {found(0, 0), found(0, 1)}, {}, {}};
  const auto count = std::ssize(result.orders);
  result.x.resize(count);
  result.y.resize(count);
  for (Eigen::Index q = 0; q < count; ++q) {
    result.x(q) = {found(1 + 2 * q, 0), found(2 + 2 * q, 0)};
    result.y(q) = {found(1 + 2 * q, 1), found(2 + 2 * q, 1)};
  }
  return result;
}

/// 1, 2, ... as far as the samples of a revolution show them.
std::vector<double> harmonics_of(const Stretch& s) {
  const double shown = 0.5 * static_cast<double>(s.size()) / s.revolutions() - 1.0;
  std::vector<double> orders;
  for (double q = 1.0; q <= std::clamp(std::floor(shown), 1.0, most_harmonics); ++q) {
    orders.push_back(q);
  }
  return orders;
}

/// What is taken off a motion.
struct SlowRoll {
  StationOrders orders;
  double speed = 0.0;  ///< [rad/s]
};

SlowRoll slow_roll_of(const TurnedMotion& motion, const StationMotion& station, double speed,
                      const OrbitFilter& filter) {
  const double at = moment_of_speed(motion.clock, speed);
  const Stretch s =
      stretch_about(motion, at, std::max(filter.revolutions, fewest_orbit_revolutions));
  return {orders_of(station, s, filter.order ? std::vector{*filter.order} : harmonics_of(s)),
          motion.clock.speed(std::clamp(at, motion.clock.first(), motion.clock.last()))};
}

/// A closed curve of orders, from a pulse on, and where pulses are on it.
void draw_orders(const TurnedMotion& motion, const StationOrders& orders, const Stretch& s,
                 double periods, StationOrbit& orbit) {
  const double first_pulse = motion.clock.angle(motion.clock.first());
  const Eigen::Index n = points_of_orbit + 1;
  orbit.t.resize(n);
  orbit.x.resize(n);
  orbit.y.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double turned =
        turn * periods * static_cast<double>(j) / static_cast<double>(points_of_orbit);
    const Complex z = orders.at(first_pulse + turned);
    orbit.t(j) = turned / orbit.speed;
    orbit.x(j) = z.real();
    orbit.y(j) = z.imag();
  }
  if (!motion.has_marks) return;
  constexpr double same = 1e-6;  // of the size
  const double size = std::max(orbit.x.cwiseAbs().maxCoeff(), orbit.y.cwiseAbs().maxCoeff());
  for (int k = 0; k < static_cast<int>(std::lround(s.revolutions())); ++k) {
    const Complex z = orders.at(first_pulse + turn * k);
    const bool is_new = std::none_of(orbit.marks.begin(), orbit.marks.end(), [&](Complex mark) {
      return std::abs(mark - z) <= same * size;
    });
    if (is_new) orbit.marks.push_back(z);
  }
}

/// Samples of x and y, with pulses between them.
void draw_samples(const TurnedMotion& motion, const Stretch& s, const Vec& x, const Vec& y,
                  StationOrbit& orbit) {
  orbit.t = motion.time.segment(s.first, s.size());
  orbit.x = x.segment(s.first, s.size());
  orbit.y = y.segment(s.first, s.size());
  const Complex mean(orbit.x.mean(), orbit.y.mean());
  orbit.x.array() -= mean.real();
  orbit.y.array() -= mean.imag();
  if (!motion.has_marks || s.size() < 2) return;
  const double spacing = motion.spacing();
  for (const double t : motion.clock.turns()) {
    const double place = (t - orbit.t(0)) / spacing;
    if (place < -1e-9 || place > static_cast<double>(s.size() - 1) + 1e-9) continue;
    const auto below =
        std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(place)), 0, s.size() - 2);
    const double part = place - static_cast<double>(below);
    orbit.marks.emplace_back((1.0 - part) * orbit.x(below) + part * orbit.x(below + 1),
                             (1.0 - part) * orbit.y(below) + part * orbit.y(below + 1));
  }
}

/// x and y of all samples without slow roll; between the first pulse and the last.
std::pair<Vec, Vec> without(const SlowRoll& runout, const TurnedMotion& motion,
                            const StationMotion& station) {
  std::pair<Vec, Vec> left{station.x, station.y};
  for (Eigen::Index j = 0; j < motion.time.size(); ++j) {
    const double t = std::clamp(motion.time(j), motion.clock.first(), motion.clock.last());
    const Complex z = runout.orders.at(motion.clock.angle(t));
    left.first(j) -= z.real();
    left.second(j) -= z.imag();
  }
  return left;
}

/// The band of a signal; of a length that is soon transformed, which has the stretch in it.
Vec band_of(const Vec& signal, const TurnedMotion& motion, const Stretch& s,
            std::pair<double, double> band) {
  const Eigen::Index n = signal.size();
  const Eigen::Index used = smooth_length(static_cast<long>(n));
  const Eigen::Index from = std::clamp<Eigen::Index>(s.first - (used - s.size()) / 2, 0, n - used);
  Vec kept = Vec::Zero(n);
  kept.segment(from, used) =
      band_passed(signal.segment(from, used), motion.spacing(), band.first, band.second);
  return kept;
}

}  // namespace

std::string OrbitFilter::text() const {
  if (order) return fmt::format("{:g}X", *order);
  if (band) return fmt::format("{:.4g} to {:.4g} Hz", band->first / hertz, band->second / hertz);
  if (is_averaged) return "average";
  return "raw";
}

double moment_of_speed(const TurnClock& clock, double speed) {
  const std::vector<double> turns = clock.turns();
  double slowest = clock.mean_speed(), fastest = slowest, nearest = 0.0, miss = 1e300;
  double before = 0.0, time_before = 0.0;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double t = 0.5 * (turns[i] + turns[i + 1]), here = turn / (turns[i + 1] - turns[i]);
    slowest = std::min(slowest, here);
    fastest = std::max(fastest, here);
    if (i > 0 && (before - speed) * (here - speed) <= 0.0 && here != before) {
      return time_before + (t - time_before) * (speed - before) / (here - before);
    }
    if (std::abs(here - speed) < miss) miss = std::abs(here - speed), nearest = t;
    before = here;
    time_before = t;
  }
  if (miss <= same_speed * speed) return nearest;
  throw OptionError(
      fmt::format("the rotor never turns at {:.6g} rpm: its speed goes from {:.6g} to "
                  "{:.6g} rpm",
                  speed / rpm, slowest / rpm, fastest / rpm));
}

StationOrbit orbit_at(const TurnedMotion& motion, std::size_t station, double at,
                      const OrbitFilter& filter) {
  const StationMotion& of = *motion.stations.at(station);
  const Stretch s = stretch_about(motion, at, filter.revolutions);
  StationOrbit orbit{.time = at, .revolutions = s.revolutions()};
  orbit.speed = motion.clock.speed(std::clamp(at, motion.clock.first(), motion.clock.last()));
  orbit.gap = {of.x.segment(s.first, s.size()).mean(), of.y.segment(s.first, s.size()).mean()};
  std::optional<SlowRoll> runout;
  if (filter.slow_roll) {
    runout = slow_roll_of(motion, of, *filter.slow_roll, filter);
    orbit.slow_roll = runout->speed;
  }
  if (filter.order || filter.is_averaged) {
    StationOrders orders =
        orders_of(of, s, filter.order ? std::vector{*filter.order} : harmonics_of(s));
    const Eigen::Index count = orders.x.size();
    if (runout) {
      const Eigen::Index both = std::min(count, runout->orders.x.size());
      orders.x.head(both) -= runout->orders.x.head(both);
      auto y = orders.y.segment(0, both);
      y -= runout->orders.y.segment(0, both);
    }
    if (filter.order) orbit.a_x = orders.x(0), orbit.a_y = orders.y(0);
    draw_orders(motion, orders, s, filter.order ? 1.0 / *filter.order : 1.0, orbit);
    return orbit;
  }
  Vec x = of.x, y = of.y;
  if (runout) std::tie(x, y) = without(*runout, motion, of);
  if (filter.band) {
    x = band_of(x, motion, s, *filter.band);
    y = band_of(y, motion, s, *filter.band);
  }
  draw_samples(motion, s, x, y, orbit);
  return orbit;
}

}  // namespace whirl::inline data
