#include "libio/text/parameter_axis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline io {

namespace {

/// The SI unit of a dimension, where it has one that people write.
std::string si_unit(const Dimension& dimension) {
  for (const char* unit :
       {"m",     "kg", "s",    "rad",  "rad/s",  "rad/s^2", "1/s",       "m/s",
        "m/s^2", "N",  "N.m",  "N/m",  "N.s/m",  "N.m/rad", "N.m.s/rad", "N/m^1.5",
        "N.m^2", "Pa", "Pa.s", "kg/m", "kg/m^3", "kg.m",    "kg.m^2",    "s/m"}) {
    if (dimension_of(unit) == dimension) return unit;
  }
  return "";
}

}  // namespace

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t place; (place = text.find(at)) != std::string_view::npos;) {
    parts.emplace_back(text.substr(0, place));
    text.remove_prefix(place + 1);
  }
  parts.emplace_back(text);
  return parts;
}

std::vector<std::string> ParameterAxis::paths() const {
  std::vector<std::string> all = split(path, ',');
  for (std::string& one : all) {
    if (one.starts_with('-')) one.erase(0, 1);
  }
  return all;
}

bool ParameterAxis::has(const std::string& one) const {
  const std::vector<std::string> all = paths();
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::vector<std::string> ParameterAxis::assignments_of(double value) const {
  std::vector<std::string> all;
  for (const std::string& one : split(path, ',')) {
    const bool is_negative = one.starts_with('-');
    all.push_back(fmt::format("{}={:.17g}{}{}", one.substr(is_negative ? 1 : 0),
                              is_negative ? -value : value, unit.empty() ? "" : " ", unit));
  }
  return all;
}

std::string label_of(const ParameterName& name) {
  return name.path + (name.unit.empty() ? "" : " [" + name.unit + "]");
}

Parsed<ParameterAxis> parse_axis(std::string_view text, int points) {
  using Result = Parsed<ParameterAxis>;
  constexpr std::string_view expected =
      "expected PATH=first:last:step, PATH=first:last with --points N, or PATH=value,value,...";
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) {
    return Result::failed(fmt::format("found {}, {}", in_quotes(text), expected));
  }
  ParameterAxis axis{.path = std::string(text.substr(0, equals))};
  const std::string_view range = text.substr(equals + 1);
  const bool is_list = range.find(':') == std::string_view::npos;
  const std::vector<std::string> parts = split(range, is_list ? ',' : ':');

  const auto last = parse_quantity(parts.back());
  if (!last) return Result::failed(fmt::format("{}; {}", last.problem, expected));
  if (last->dimension != Dimension{}) {
    axis.unit = si_unit(last->dimension);
    if (axis.unit.empty()) {
      return Result::failed(
          fmt::format("found {}, expected a unit of something that a model has; or write numbers "
                      "in SI without a unit",
                      in_quotes(range)));
    }
    axis.shown_unit = last->unit;
    axis.shown_scale = parse_quantity("1 " + last->unit)->value;
  }
  if (!is_list) {
    const auto parsed = parse_range(range, last->dimension);
    if (!parsed) return Result::failed(parsed.problem);
    if (!parsed->step && points < 1) {
      return Result::failed(fmt::format("{} has no step: write first:last:step, or say --points N",
                                        in_quotes(range)));
    }
    axis.values = parsed->step ? values(*parsed) : values(*parsed, points);
    return axis;
  }
  for (const std::string& part : parts) {
    const auto quantity = parse_quantity(part);
    const bool is_bare = quantity && quantity->unit.empty();
    const auto value = is_bare ? parse_quantity(part + ' ' + last->unit) : quantity;
    if (!value) return Result::failed(fmt::format("{}; {}", value.problem, expected));
    if (value->dimension != last->dimension) {
      return Result::failed(
          fmt::format("{} mixes units of different dimensions", in_quotes(range)));
    }
    axis.values.push_back(value->value);
  }
  return axis;
}

std::vector<ParameterAxis> parse_axes(const std::vector<std::string>& texts, int points,
                                      std::size_t least, std::size_t most) {
  std::vector<ParameterAxis> axes;
  for (const std::string& text : texts) {
    const auto axis = parse_axis(text, points);
    if (!axis) throw wrong_option("over", text, axis.problem);
    axes.push_back(*axis);
  }
  constexpr double most_in_all = 1e8;
  double points_in_all = 1.0;
  for (const ParameterAxis& axis : axes) points_in_all *= static_cast<double>(axis.values.size());
  if (points_in_all > most_in_all) {
    throw ModelError({"--over"}, "",
                     fmt::format("found {:.4g} points in all, expected up to {:.0f} million",
                                 points_in_all, 1e-6 * most_in_all));
  }
  if (least <= axes.size() && axes.size() <= most) return axes;
  const std::string right =
      least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  throw ModelError(
      {"--over"}, "",
      fmt::format("found {} of them, expected {}: --over PATH=first:last:step, such as "
                  "--over operation.speed=100:200:1rad/s",
                  axes.size(), right));
}

}  // namespace whirl::inline io
