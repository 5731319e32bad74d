#include "libio/text/lateral_values.hpp"

#include "libio/text/parameter_axis.hpp"

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
  return parse_above_zero(text, "N/m");
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

}  // namespace whirl::inline io
