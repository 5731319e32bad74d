#include "libio/text/format.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

/// The ways to write a unit, ascending.
std::vector<ShownUnit> ladder(std::string_view si_unit) {
  struct Prefix {
    char letter;  ///< 0: none
    double size;
  };
  static constexpr Prefix prefixes[] = {{'n', 1e-9}, {'u', 1e-6}, {'m', 1e-3}, {0, 1.0},
                                        {'k', 1e3},  {'M', 1e6},  {'G', 1e9}};
  const std::string unit(si_unit);
  if (unit == "kg") return {{"mg", 1e-6, 1e-6}, {"g", 1e-3, 1e-3}, {"kg", 1.0, 1.0}};
  if (unit == "kg.m") return {{"g.mm", 1e-6, 1e-6}, {"kg.mm", 1e-3, 1e-3}, {"kg.m", 1.0, 1.0}};

  // N and Pa go both ways, lengths, times and angles only down
  const std::size_t end = unit.find_first_of("./^");
  const std::string symbol = unit.substr(0, end);
  const bool has_exponent = end != std::string::npos && unit[end] == '^';
  const bool goes_up = symbol == "N" || symbol == "Pa";
  const bool goes_down = goes_up || symbol == "m" || symbol == "rad" || unit == "s";
  if (has_exponent || !goes_down) return {{unit, 1.0}};
  std::vector<ShownUnit> rungs;
  for (const Prefix& prefix : prefixes) {
    if (prefix.size > 1.0 && !goes_up) continue;
    rungs.push_back({prefix.letter == 0 ? unit : prefix.letter + unit, prefix.size, prefix.size});
  }
  return rungs;
}

double rounded_to(int digits, double value) {
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  std::from_chars(rounded.data(), rounded.data() + rounded.size(), value);
  return value;
}

std::string number_and_unit(double value, const std::string& unit, int digits = 4) {
  const std::string number = fmt::format("{:.10g}", rounded_to(digits, value));
  return unit.empty() ? number : number + ' ' + unit;
}

}  // namespace

std::string format_engineering(double value, std::string_view si_unit, int digits) {
  const double size = std::abs(rounded_to(digits, value));  // rounded first: 999.96 N is 1 kN
  const std::vector<ShownUnit>* choice = shown_units().choice(si_unit);
  if (!choice && (size == 0.0 || !std::isfinite(value))) {
    return number_and_unit(value, std::string(si_unit));
  }
  const std::vector<ShownUnit> rungs = choice ? *choice : ladder(si_unit);
  const ShownUnit* rung = &rungs.front();
  for (const ShownUnit& candidate : rungs) {
    if (size >= candidate.least * (1.0 - 1e-12)) rung = &candidate;
  }
  return number_and_unit(value / rung->size, rung->name, digits);
}

std::string format_number(double value, std::string_view format) {
  constexpr double largest = 1e9;  // beyond it digits behind the point say nothing
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "-∞";
  if (std::abs(value) >= largest && format.ends_with('f')) {
    return fmt::format(fmt::runtime(format.starts_with('+') ? "{:+.4g}" : "{:.4g}"), value);
  }
  std::string text = fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), value);
  const bool is_zero = text.find_first_of("123456789ni") == std::string::npos;
  if (!is_zero || !text.starts_with('-')) return text;
  return (format.starts_with('+') ? "+" : "") + text.substr(1);
}

std::string format_length(double value) {
  return format_engineering(value, "m");
}

std::string format_grouped(double value) {
  if (!(std::abs(value) >= 999.95 && std::abs(value) < 1e15)) return fmt::format("{:.4g}", value);
  std::string text = fmt::format("{:.0f}", std::abs(value));
  for (std::size_t digits = 3; text.size() > 4 && digits < text.size(); digits += 4) {
    text.insert(text.size() - digits, 1, ' ');
  }
  return (value < 0.0 ? "-" : "") + text;
}

std::string format_tolerance(double tolerance) {
  const int power = static_cast<int>(std::floor(std::log10(tolerance) + 1e-9));
  return fmt::format("{:.4g}e{}", tolerance / std::pow(10.0, power), power);
}

std::string format_speed(double value) {
  const ShownUnit unit = shown_unit("rpm");
  return number_and_unit(value / unit.size, unit.name);
}

}  // namespace whirl::inline io
