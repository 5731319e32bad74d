#include "libio/text/lateral_values.hpp"

#include <fmt/format.h>

#include "libio/text/parameter_axis.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

Parsed<double> parse_above_zero(std::string_view text, const char* unit) {
  const auto value = parse_as(text, unit);
  if (!value || *value > 0.0) return value;
  return Parsed<double>::failed("expected a number above zero");
}

}  // namespace

Parsed<double> parse_running_speed(std::string_view text) {
  return parse_above_zero(text, "rad/s");
}

Parsed<double> parse_coupling(std::string_view text) {
  const auto value = parse_above_zero(text, "N/m");
  if (value) return value;
  return Parsed<double>::failed(value.problem + vendor_hint(std::string(text), "N/m"));
}

Parsed<double> parse_gas_density(std::string_view text) {
  return parse_above_zero(text, "kg/m^3");
}

/// "1200kW:450mm:18mm:1.3,...": power, diameter, width and density ratio of impellers.
Parsed<std::vector<Stage>> parse_stages(std::string_view text) {
  using Stages = Parsed<std::vector<Stage>>;
  std::vector<Stage> stages;
  for (const std::string& one : split(text, ',')) {
    const std::vector<std::string> parts = split(one, ':');
    if (parts.size() != 4) {
      return Stages::failed(
          "expected power, diameter, width and density ratio of each, as 1200kW:450mm:18mm:1.3");
    }
    const auto power = parse_above_zero(parts[0], "W"), diameter = parse_above_zero(parts[1], "m"),
               width = parse_above_zero(parts[2], "m"), ratio = parse_above_zero(parts[3], "");
    for (const auto* part : {&power, &diameter, &width, &ratio}) {
      if (!*part) return Stages::failed(part->problem);
    }
    stages.push_back({*power, *diameter, *width, *ratio});
  }
  return stages;
}

std::vector<std::string> bare_value_notes(const std::string& coupling,
                                          const std::string& gas_density) {
  constexpr double foot = 0.3048, inch = foot / 12.0, pound = 0.45359237;
  constexpr double pound_force = 9.80665 * pound;
  std::vector<std::string> notes;
  const auto read = [&](const char* option, const std::string& text, const char* si,
                        const char* other, double factor) {
    const auto quantity = parse_quantity(text);
    if (!quantity || !quantity->unit.empty()) return;
    notes.push_back(
        fmt::format("--{0} {1} has no unit and means {2:g} {3} = {4:.4g} {5}; for {5} write {1}{5}",
                    option, text, quantity->value, si, quantity->value / factor, other));
  };
  read("cross-coupling", coupling, "N/m", "lbf/in", pound_force / inch);
  read("gas-density", gas_density, "kg/m^3", "lb/ft^3", pound / (foot * foot * foot));
  return notes;
}

}  // namespace whirl::inline io
