#include "libio/text/value_range.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <functional>

namespace whirl::inline io {

namespace {

constexpr double most_points = 1e6;
constexpr double same_step = 1e-9;

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t colon; (colon = text.find(':')) != std::string_view::npos;) {
    parts.emplace_back(text.substr(0, colon));
    text.remove_prefix(colon + 1);
  }
  parts.emplace_back(text);
  return parts;
}

/// How many whole steps fit between first and last.
double whole_steps(const ValueRange& range) {
  return std::floor((range.last - range.first) / *range.step + same_step);
}

/// @param number  of a part, with the unit it goes by
Parsed<ValueRange> parse_with(std::string_view text,
                              const std::function<Parsed<double>(const std::string&)>& number_of) {
  using Result = Parsed<ValueRange>;
  const std::vector<std::string> parts = split(text);
  if (parts.size() != 2 && parts.size() != 3) {
    return Result::failed(
        fmt::format("found {}, expected first:last or first:last:step, such as {}", in_quotes(text),
                    "0:8000:50rpm"));
  }

  // a bare part takes the unit of the last one
  const auto last_part = parse_quantity(parts.back());
  const std::string unit = last_part ? last_part->unit : "";
  std::vector<double> numbers;
  for (const std::string& part : parts) {
    const auto quantity = parse_quantity(part);
    const bool is_bare = quantity && quantity->unit.empty();
    const auto number = number_of(is_bare && !unit.empty() ? part + ' ' + unit : part);
    if (!number)
      return Result::failed(fmt::format("{}, in the range {}", number.problem, in_quotes(text)));
    if (!is_bare && unit.empty()) {
      return Result::failed(
          fmt::format("{}: some parts have a unit and the last has none; write it at the end",
                      in_quotes(text)));
    }
    numbers.push_back(*number);
  }

  ValueRange range{.first = numbers[0], .last = numbers[1]};
  if (range.last < range.first) {
    return Result::failed(fmt::format("{}: the last value is below the first", in_quotes(text)));
  }
  if (numbers.size() == 3) {
    range.step = numbers[2];
    if (!(*range.step > 0.0)) {
      return Result::failed(fmt::format("{}: the step must be positive", in_quotes(text)));
    }
    if (!(whole_steps(range) < most_points)) {
      return Result::failed(
          fmt::format("{}: more than {:.0f} million values", in_quotes(text), 1e-6 * most_points));
    }
  }
  return range;
}

}  // namespace

Parsed<ValueRange> parse_range(std::string_view text, std::string_view si_unit) {
  return parse_with(text, [&](const std::string& part) { return parse_as(part, si_unit); });
}

Parsed<ValueRange> parse_range(std::string_view text, const Dimension& dimension) {
  return parse_with(text, [&](const std::string& part) {
    const auto quantity = parse_quantity(part);
    if (!quantity) return Parsed<double>::failed(quantity.problem);
    if (quantity->dimension == dimension) return Parsed<double>(quantity->value);
    return Parsed<double>::failed(
        fmt::format("{} is of another dimension than the rest", in_quotes(part)));
  });
}

std::vector<double> values(const ValueRange& range) {
  assert(range.step && *range.step > 0.0);
  const double steps = whole_steps(range);
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(steps) + 1);
  for (double i = 0.0; i <= steps; ++i) result.push_back(range.first + i * *range.step);
  if (std::abs(result.back() - range.last) <= same_step * *range.step) result.back() = range.last;
  return result;
}

std::vector<double> values(const ValueRange& range, int points) {
  assert(points >= 1);
  if (points == 1) return {range.first};
  std::vector<double> result;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    result.push_back(range.first + share * (range.last - range.first));
  }
  result.back() = range.last;
  return result;
}

}  // namespace whirl::inline io
