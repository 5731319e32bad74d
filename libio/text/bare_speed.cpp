#include "libio/text/bare_speed.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libio/text/format.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// The numbers of "3000", "0:8000:50" or "100,200"; nothing if one has a unit, or is no number.
std::optional<std::vector<double>> bare_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find_first_of(":,", from), text.size());
    const auto quantity = parse_quantity(text.substr(from, to - from));
    if (!quantity || !quantity->unit.empty()) return std::nullopt;
    numbers.push_back(quantity->value);
    from = to + 1;
  }
  return numbers;
}

/// "3000 rad/s = 28 648 rpm", of a range its ends.
std::optional<std::string> readings_of(const std::string& text) {
  auto numbers = bare_numbers(text);
  if (!numbers) return std::nullopt;
  const bool has_step = text.find(':') != std::string::npos && numbers->size() == 3;
  if (has_step) numbers->pop_back();
  const double low = *std::min_element(numbers->begin(), numbers->end());
  const double high = *std::max_element(numbers->begin(), numbers->end());
  if (low == 0.0 && high == 0.0) return std::nullopt;
  const auto both = [&](double factor) {
    return low == high ? format_grouped(high * factor)
                       : format_grouped(low * factor) + " to " + format_grouped(high * factor);
  };
  return fmt::format("{} rad/s = {} rpm", both(1.0), both(1.0 / rpm));
}

}  // namespace

std::string BareSpeed::reading() const {
  return fmt::format("speed: {} (no unit given; for revolutions per minute write {}rpm)", readings,
                     value);
}

std::string BareSpeed::warning() const {
  const std::string space = option.ends_with('=') ? "" : " ";
  return fmt::format(
      "{0}{1}{2} has no unit and means {3}; for revolutions per minute write {0}{1}{2}rpm", option,
      space, value, readings);
}

bool is_bare(std::string_view text) {
  return bare_numbers(text).has_value();
}

std::optional<BareSpeed> bare_speed(const std::string& option, const std::string& value) {
  const auto readings = readings_of(value);
  return readings ? std::optional(BareSpeed{option, value, *readings}) : std::nullopt;
}

std::vector<BareSpeed> bare_speeds(const SpeedOptions& given) {
  const std::string assigned = "operation.speed=";
  std::vector<BareSpeed> found;
  const auto look_at = [&](const std::string& option, const std::string& value) {
    if (const auto bare = bare_speed(option, value)) found.push_back(*bare);
  };
  look_at("--speed", given.speed);
  for (const std::string& set : given.sets) {
    if (set.starts_with(assigned)) look_at("--set " + assigned, set.substr(assigned.size()));
  }
  look_at("--speeds", given.speeds);
  for (const auto& [option, value] : given.others) look_at(option, value);
  for (const std::string& over : given.over) {
    if (!over.starts_with(assigned)) continue;
    const std::string values = over.substr(assigned.size());
    look_at("--over " + assigned, values);
    // a bare value beside a range with a unit has the range's
    if (given.over.size() == 1 && is_bare(values)) look_at("--at", given.at);
  }
  return found;
}

}  // namespace whirl::inline io
