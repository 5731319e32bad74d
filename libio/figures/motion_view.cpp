#include "libio/figures/motion_view.hpp"

#include <sstream>

#include "libio/text/value_range.hpp"

namespace whirl::inline io {

Parsed<Moments> parse_moments(const std::string& text) {
  const auto wrong = [] {
    return Parsed<Moments>::failed(
        "expected speeds or times with their units, such as 1500rpm,3000rpm or 2s");
  };
  Moments moments;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    const auto speed = parse_as(one, "rad/s"), time = parse_as(one, "s");
    if (bool(speed) == bool(time)) return wrong();  // neither, or without a unit
    if (speed && !(*speed > 0.0)) return wrong();
    speed ? moments.speeds.push_back(*speed) : moments.times.push_back(*time);
  }
  if (moments.speeds.empty() == moments.times.empty()) return wrong();
  return moments;
}

Parsed<std::pair<double, double>> parse_band(const std::string& text) {
  using Band = std::pair<double, double>;
  const auto range = parse_range(text, "rad/s");
  if (!range) return Parsed<Band>::failed(range.problem);
  if (range->step || range->first < 0.0 || !(range->first < range->last)) {
    return Parsed<Band>::failed("expected two frequencies, such as 10:200Hz");
  }
  return Band{range->first, range->last};
}

}  // namespace whirl::inline io
