#include "libio/drawing/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::inline io {

namespace {

constexpr double slack = 1e-9;            ///< of a step: rounding at the limits
constexpr double largest_limit = 1e300;   ///< limits beyond it would overflow
constexpr double nearest_limits = 1e-12;  ///< of the limits: steps between nearer ones are rounding

/// 1, 2 or 5 times a power of ten, not below a number.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= value * (1.0 - slack)) return digit * power;
  }
  return 10.0 * power;
}

double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + slack));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value * (1.0 + slack)) return digit * power;
  }
  return power;
}

/// A number with a minus sign, which is longer than a hyphen.
std::string label(double value, int digits = 6) {
  const std::string text = fmt::format("{:.{}g}", std::abs(value), digits);
  return value < 0.0 ? "−" + text : text;
}

/// Digits that tell a step from the next one.
int digits_of(const Axis& axis, double step) {
  const double largest = std::max(std::abs(axis.first), std::abs(axis.last));
  const double digits =
      1.0 + std::floor(std::log10(largest)) - std::floor(std::log10(step) + slack);
  return static_cast<int>(std::clamp(digits, 6.0, 17.0));
}

std::vector<Tick> ticks_every(const Axis& axis, double step) {
  std::vector<Tick> ticks;
  const double from = std::ceil(axis.first / step - slack), to = axis.last / step + slack;
  // of a range that rounding cannot tell from a point there are none
  constexpr double most = 1000.0, whole = 1e15;
  if (!(to - from < most) || !(std::abs(from) < whole)) return ticks;
  const int digits = digits_of(axis, step);
  for (double i = from; i <= to; ++i) {
    ticks.push_back({i * step, label(i * step, digits)});
  }
  return ticks;
}

/// As many as there is room for, but two at least: one alone tells no size.
std::vector<Tick> linear_ticks(const Axis& axis, int most) {
  double step = round_up((axis.last - axis.first) / most);
  std::vector<Tick> ticks = ticks_every(axis, step);
  constexpr int tries = 4;
  for (int i = 0; i < tries && ticks.size() < 2; ++i) {
    step = round_down(0.75 * step);
    ticks = ticks_every(axis, step);
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(const Axis& axis, int most) {
  const int from = static_cast<int>(std::floor(std::log10(axis.first) + slack));
  const int to = static_cast<int>(std::ceil(std::log10(axis.last) - slack));
  const int low = static_cast<int>(std::ceil(std::log10(axis.first) - slack));
  const int high = static_cast<int>(std::floor(std::log10(axis.last) + slack));
  int start = from, stride = std::max(1, (to - from + most) / most);  // powers per label
  const int next = from + stride * ((low - from + stride - 1) / stride);
  if (next + stride > high && high > low) {  // two at least where two are seen
    start = low;
    stride = (high - low + most) / most;
  }
  std::vector<Tick> ticks;
  for (int power = from; power <= to; ++power) {
    const double decade = std::pow(10.0, power);
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * decade;
      if (value < axis.first * (1.0 - slack) || value > axis.last * (1.0 + slack)) continue;
      if (digit == 1) {
        const bool is_labelled = (power - start) % stride == 0;
        ticks.push_back({value, is_labelled ? fmt::format("10^{{{}}}", label(power)) : ""});
      } else if (stride == 1) {
        ticks.push_back({value, ""});
      }
    }
  }
  return ticks;
}

}  // namespace

double Axis::place(double value) const {
  if (scale == Scale::linear) return (value - first) / (last - first);
  return std::log(value / first) / std::log(last / first);
}

std::vector<Tick> Axis::ticks(int most) const {
  if (scale == Scale::linear) return linear_ticks(*this, most);
  std::vector<Tick> powers = logarithmic_ticks(*this, most);
  const auto labelled =
      std::count_if(powers.begin(), powers.end(), [](const Tick& t) { return !t.label.empty(); });
  if (labelled >= 2) return powers;
  std::vector<Tick> ticks = linear_ticks(*this, most);
  std::erase_if(ticks, [](const Tick& t) { return t.value <= 0.0; });  // it has no place here
  return ticks;
}

bool can_be_drawn(const Axis& axis) {
  if (!(std::abs(axis.first) <= largest_limit && std::abs(axis.last) <= largest_limit))
    return false;
  if (axis.scale == Scale::logarithmic) {
    return axis.first >= 1.0 / largest_limit && axis.last > axis.first * (1.0 + nearest_limits);
  }
  return axis.last - axis.first >
         nearest_limits * std::max(std::abs(axis.first), std::abs(axis.last));
}

Axis axis_around(const std::vector<double>& values, Scale scale) {
  const bool is_log = scale == Scale::logarithmic;
  double least = INFINITY, largest = -INFINITY;
  for (const double v : values) {
    if (!(std::abs(v) <= largest_limit) || (is_log && v < 1.0 / largest_limit)) continue;
    least = std::min(least, v);
    largest = std::max(largest, v);
  }
  if (least > largest) return {scale, is_log ? 1.0 : 0.0, is_log ? 10.0 : 1.0};
  if (is_log) {
    // at digits 1, 2, 5 if that leaves two powers of ten to be labelled, else at powers
    const double from = round_down(least), to = round_up(largest);
    const double power = std::pow(10.0, std::ceil(std::log10(from) - slack));
    if (10.0 * power <= to * (1.0 + slack)) return {scale, from, to};
    const double first = std::floor(std::log10(least) + slack);
    const double last = std::max(first + 1.0, std::ceil(std::log10(largest) - slack));
    return {scale, std::pow(10.0, first), std::pow(10.0, last)};
  }
  if (!can_be_drawn({scale, least, largest})) {
    const double room = least == 0.0 ? 1.0 : 0.5 * std::abs(least);
    least -= room;
    largest += room;
  }
  const double step = round_up((largest - least) / 8.0);
  return {scale, step * std::floor(least / step + slack), step * std::ceil(largest / step - slack)};
}

std::vector<double> spread(const std::vector<double>& wanted, double distance, double low,
                           double high) {
  // neighbours that are too near form a group around the mean of what they want
  struct Group {
    double sum = 0.0;  // of wanted places less the offsets within the group
    double count = 0.0;
    double start() const { return sum / count; }
  };
  std::vector<Group> groups;
  for (const double place : wanted) {
    groups.push_back({place, 1.0});
    while (groups.size() > 1) {
      const Group last = groups.back();
      Group& before = groups[groups.size() - 2];
      if (before.start() + before.count * distance <= last.start()) break;
      before.sum += last.sum - last.count * before.count * distance;
      before.count += last.count;
      groups.pop_back();
    }
  }
  std::vector<double> places;
  for (const Group& g : groups) {
    for (double i = 0.0; i < g.count; ++i) places.push_back(g.start() + i * distance);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {  // down into the range, then up
    places[i] = std::max(places[i], low + static_cast<double>(i) * distance);
  }
  for (std::size_t i = places.size(); i-- > 0;) {
    const auto behind = static_cast<double>(places.size() - 1 - i);
    places[i] = std::min(places[i], high - behind * distance);
  }
  return places;
}

}  // namespace whirl::inline io
