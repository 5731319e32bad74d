#include "libio/texts/row_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

Shown Shown::as(std::string_view other) const {
  Shown renamed = *this;
  renamed.heading = other;
  return renamed;
}

Shown shown(std::string_view key, std::string_view unit, std::string_view format) {
  std::string heading(key);
  std::replace(heading.begin(), heading.end(), '_', ' ');
  return {key, unit, format, std::move(heading)};
}

namespace texts {

NumberStyle style_of(const Shown& shown, std::string_view si_unit) {
  NumberStyle style{.format = std::string(shown.format), .si_unit = std::string(si_unit)};
  if (shown.unit.empty()) {
    if (!style.format.empty()) style.unit = si_unit;
  } else if (shown.unit == "%" && si_unit.empty()) {
    style.unit = shown.unit;
    style.divisor = 0.01;
  } else {
    const auto one = parse_as("1 " + std::string(shown.unit), si_unit);
    if (!one) throw std::logic_error(std::string(shown.key) + ": " + one.problem);
    style.unit = shown.unit;
    style.divisor = *one;
  }
  if (!style.unit.empty() && shown_units().choice(si_unit)) {
    const ShownUnit to = shown_unit(style.unit);
    style.format = format_for(style.format, to.size / style.divisor);
    style.unit = to.name, style.divisor = to.size;
  }
  return style;
}

std::string heading_of(const Shown& shown, const NumberStyle& style) {
  if (style.unit.empty()) return shown.heading;
  return fmt::format("{}{}[{}]", shown.heading, shown.heading.empty() ? "" : " ", style.unit);
}

std::string number_text(double value, std::string_view format) {
  return format_number(value, format);
}

std::string number_text(double value, const NumberStyle& style) {
  if (!style.format.empty()) return number_text(value / style.divisor, style.format);
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "-∞";
  return format_engineering(value / style.divisor, style.unit.empty() ? style.si_unit : "");
}

}  // namespace texts

}  // namespace whirl::inline io
