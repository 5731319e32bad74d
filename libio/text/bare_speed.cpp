#include "apps/bare_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/verbs/common.hpp"
#include "libio/text/format.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline cli {

namespace {

const std::string path = "operation.speed";

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
  const auto [low, high] = std::minmax_element(numbers->begin(), numbers->end());
  if (*low == 0.0 && *high == 0.0) return std::nullopt;
  const auto both = [&](double factor) {
    return *low == *high ? format_grouped(*high * factor)
                         : format_grouped(*low * factor) + " to " + format_grouped(*high * factor);
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

std::vector<BareSpeed> bare_speeds(const Invocation& call, const std::string& speed) {
  std::vector<BareSpeed> found;
  const auto look_at = [&](const std::string& option, const std::string& value) {
    if (const auto readings = readings_of(value)) found.push_back({option, value, *readings});
  };
  const auto look_behind_path = [&](const std::string& option, const std::string& assignment) {
    if (!assignment.starts_with(path + "=")) return false;
    look_at(option + " " + path + "=", assignment.substr(path.size() + 1));
    return true;
  };
  std::vector<std::string> sets = call.sets;
  if (!speed.empty()) {
    sets.pop_back();  // it is the last of them
    look_at("--speed", speed);
  }
  for (const std::string& set : sets) look_behind_path("--set", set);
  if (call.has("speeds")) look_at("--speeds", call.text("speeds"));
  const std::string at = call.text("at");
  for (std::size_t i = 0; i < call.over.size(); ++i) {
    const bool is_speed = look_behind_path("--over", call.over[i]);
    const bool is_bare = is_speed && bare_numbers(call.over[i].substr(path.size() + 1));
    // a bare value beside a range with a unit has the range's
    if (is_bare && call.over.size() == 1 && !at.empty()) look_at("--at", at);
  }
  return found;
}

}  // namespace whirl::inline cli
