#include "libio/text/shown_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

/// Units of one quantity; those behind the first are preferred from a value on, told in them.
struct Entry {
  std::string_view si_unit;
  std::array<std::string_view, 2> units;
  double from = 1.0;  ///< of the second unit
};

constexpr Entry us[] = {{"m", {"mil", "in"}, 0.1},
                        {"N", {"lbf", ""}},
                        {"N/m", {"lbf/in", ""}},
                        {"N.s/m", {"lbf.s/in", ""}},
                        {"kg", {"oz", "lb"}, 1.0},
                        {"kg.m", {"oz.in", ""}},
                        {"kg.m^2", {"lb.in^2", ""}},
                        {"kg/m^3", {"lb/in^3", ""}},
                        {"Pa", {"psi", ""}},
                        {"Pa.s", {"reyn", ""}},
                        {"N.m", {"lbf.in", ""}},
                        {"N.m/rad", {"lbf.in/rad", ""}},
                        {"N.m.s/rad", {"lbf.in.s/rad", ""}},
                        {"m/s", {"in/s", ""}},
                        {"m/s^2", {"in/s^2", ""}},
                        {"m/N", {"mil/lbf", ""}},
                        {"m/(N.s)", {"in/lbf/s", ""}},
                        {"1/kg", {"1/lb", ""}},
                        {"W", {"hp", ""}}};

constexpr Entry cgs[] = {{"m", {"um", "cm"}, 0.1},
                         {"N", {"dyn", ""}},
                         {"N/m", {"dyn/cm", ""}},
                         {"N.s/m", {"dyn.s/cm", ""}},
                         {"kg", {"g", ""}},
                         {"kg.m", {"g.cm", ""}},
                         {"kg.m^2", {"g.cm^2", ""}},
                         {"kg/m^3", {"g/cm^3", ""}},
                         {"Pa", {"dyn/cm^2", ""}},
                         {"Pa.s", {"P", ""}},
                         {"N.m", {"dyn.cm", ""}},
                         {"N.m/rad", {"dyn.cm/rad", ""}},
                         {"N.m.s/rad", {"dyn.cm.s/rad", ""}},
                         {"m/s", {"cm/s", ""}},
                         {"m/s^2", {"cm/s^2", ""}},
                         {"m/N", {"cm/dyn", ""}}};

/// "m/(N.s)" as dimension_of takes it.
std::string as_product(std::string_view si_unit) {
  if (si_unit == "m/(N.s)") return "m/N/s";
  if (si_unit == "W") return "N.m/s";
  return std::string(si_unit);
}

/// Dimension of an SI unit; nothing where columns hold several ("m, rad") or none.
std::optional<Dimension> dimension_if(std::string_view si_unit) {
  if (si_unit.empty() || si_unit.find(',') != std::string_view::npos) return std::nullopt;
  try {
    return dimension_of(as_product(si_unit));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

double size_of(std::string_view unit) {
  const auto one = parse_quantity("1 " + as_product(unit));
  if (!one) throw std::invalid_argument("no unit: " + std::string(unit));
  return one->value;
}

std::vector<ShownUnit> units_of(const Entry& entry) {
  std::vector<ShownUnit> units{{std::string(entry.units[0]), size_of(entry.units[0]), 0.0}};
  if (!entry.units[1].empty()) {
    const double size = size_of(entry.units[1]);
    units.push_back({std::string(entry.units[1]), size, entry.from * size});
  }
  return units;
}

/// Whether a text has more quantities in units of US customs than in those of SI.
bool is_written_in_us(std::string_view model) {
  static constexpr std::string_view of_us[] = {"in", "mil", "lb", "lbf", "psi", "ft", "oz", "ksi"};
  static constexpr std::string_view of_si[] = {"m", "mm", "um", "kg", "N", "kN", "MN", "GPa", "Pa"};
  long balance = 0;
  for (std::size_t i = 0; i < model.size();) {
    const std::size_t begin = i;
    while (i < model.size() && std::isalpha(static_cast<unsigned char>(model[i]))) ++i;
    const std::string_view word = model.substr(begin, i - begin);
    const bool follows_number =
        begin > 0 && (std::isdigit(static_cast<unsigned char>(model[begin - 1])) ||
                      (begin > 1 && model[begin - 1] == ' ' &&
                       std::isdigit(static_cast<unsigned char>(model[begin - 2]))));
    if (follows_number && std::ranges::find(of_us, word) != std::end(of_us)) ++balance;
    if (follows_number && std::ranges::find(of_si, word) != std::end(of_si)) --balance;
    if (i == begin) ++i;
  }
  return balance > 0;
}

ShownUnits& in_use() {
  static ShownUnits units;
  return units;
}

}  // namespace

Parsed<ShownUnits> ShownUnits::named(std::string_view list, std::string_view model) {
  ShownUnits units;
  std::span<const Entry> system;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    const std::string_view name = list.substr(0, end);
    list.remove_prefix(std::min(end + 1, list.size()));
    if (name == "si") continue;
    if (name == "us" || (name == "file" && is_written_in_us(model))) {
      system = us;
    } else if (name == "cgs") {
      system = cgs;
    } else if (name == "none") {
      units.is_bare_ = true;
    } else if (name != "file") {
      const auto unit = parse_quantity("1 " + std::string(name));
      if (!unit || unit->unit.empty()) {
        return Parsed<ShownUnits>::failed(fmt::format(
            "expected us, si, cgs, none, file or units such as rad/s or kN, with commas "
            "between them; \"{}\" is none of these",
            name));
      }
      units.choices_.push_back({unit->dimension, {{std::string(name), unit->value, 0.0}}});
    }
  }
  for (const Entry& entry : system) {
    units.choices_.push_back({*dimension_if(entry.si_unit), units_of(entry)});
  }
  return units;
}

const std::vector<ShownUnit>* ShownUnits::choice_of(const Dimension& dimension) const {
  if (is_si()) return nullptr;
  const auto found = std::ranges::find(choices_, dimension, &Choice::dimension);
  if (found != choices_.end()) return &found->units;
  return is_bare_ ? &bare_ : nullptr;
}

const std::vector<ShownUnit>* ShownUnits::choice(std::string_view si_unit) const {
  if (is_si()) return nullptr;
  const auto dimension = dimension_if(si_unit);
  return dimension ? choice_of(*dimension) : nullptr;
}

const ShownUnits& shown_units() {
  return in_use();
}

void show_in(ShownUnits units) {
  in_use() = std::move(units);
}

std::string format_for(std::string_view format, double ratio) {
  const std::size_t point = format.find('.');
  if (point == std::string_view::npos || !format.ends_with('f') || !(ratio > 0.0)) {
    return std::string(format);
  }
  const int digits = std::stoi(std::string(format.substr(point + 1)));
  const int more = static_cast<int>(std::floor(std::log10(ratio) + 0.3));
  return fmt::format("{}.{}f", format.substr(0, point), std::clamp(digits + more, 0, 9));
}

ShownUnit shown_unit(std::string_view unit) {
  const ShownUnits& units = in_use();
  const double size = size_of(unit);
  if (units.is_si()) return {std::string(unit), size};
  const std::vector<ShownUnit>* choice =
      units.choice_of(parse_quantity("1 " + std::string(unit))->dimension);
  if (!choice) return {std::string(unit), size};
  return *std::ranges::min_element(
      *choice, {}, [&](const ShownUnit& u) { return std::abs(std::log(u.size / size)); });
}

ShownUnit speed_unit() {
  return shown_unit("rpm");
}

std::string shown_number(double value, std::string_view unit, std::string_view format) {
  const ShownUnit to = shown_unit(unit);
  if (to.name.empty()) return format_number(value / to.size, ".6g");  // of any size
  return format_number(value / to.size, format_for(format, to.size / size_of(unit)));
}

std::string shown_digits(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return "-";
  const double shown = value / shown_unit(unit).size;
  return fmt::format("{:.{}g}", shown == 0.0 ? 0.0 : shown, digits);
}

std::string shown_value(double value, std::string_view unit, std::string_view format) {
  const std::string name = shown_unit(unit).name;
  return shown_number(value, unit, format) + (name.empty() ? "" : " " + name);
}

std::string shown_heading(std::string_view what, std::string_view unit) {
  const std::string name = shown_unit(unit).name;
  return name.empty() ? std::string(what)
                      : fmt::format("{}{}[{}]", what, what.empty() ? "" : " ", name);
}

}  // namespace whirl::inline io
