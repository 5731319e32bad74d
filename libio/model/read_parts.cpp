#include "libio/model/read_parts.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// At the left end and at the right one.
std::optional<std::pair<double, double>> diameters(TableReader& table, std::string_view key,
                                                   Range range) {
  const ConfigNode* node = table.node(key);
  if (!node || node->kind != ConfigNode::Kind::array) {
    const auto both = table.quantity(key, "m", range);
    if (!both) return std::nullopt;
    return std::pair(*both, *both);
  }
  const auto ends = table.pair(key, "m", range, "one value, or [left, right]");
  if (!ends) return std::nullopt;
  return std::pair(ends->front(), ends->back());
}

}  // namespace

std::optional<Station> station_at(ModelReading& reading, TableReader& table, std::string_view key,
                                  bool may_be_ground) {
  const ConfigNode* node = table.node(key);
  if (!node) {
    table.missing(key, fmt::format("a body's name, {}{{ at = position }} or {{ node = number }}",
                                   may_be_ground ? "\"ground\", " : ""));
    return std::nullopt;
  }
  if (node->kind == ConfigNode::Kind::table) {
    TableReader place = reading.inner(table, key);
    auto found = reading.station(place);
    place.finish();
    return found;
  }
  const auto name = table.string(key);
  return name ? reading.named_station(*name, table, key, may_be_ground) : std::nullopt;
}

void read_diameters(TableReader& table, Section& left, Section& right,
                    const std::vector<std::string>& instead, bool needs_inner) {
  const auto outer = diameters(table, "outer_diameter", Range::positive);
  if (!table.has("outer_diameter")) {
    table.missing("outer_diameter", expected_quantity("m"), instead);
  }
  const auto inner = diameters(table, "inner_diameter", Range::nonnegative);
  if (needs_inner && !table.has("inner_diameter")) {
    table.missing("inner_diameter", "a length (m): the outer diameter of what it lies on, or 0");
  }
  if (outer) {
    left.outer = outer->first;
    right.outer = outer->second;
  }
  if (inner) {
    left.inner = inner->first;
    right.inner = inner->second;
  }
  for (const auto& [in, out] :
       {std::pair(left.inner, left.outer), std::pair(right.inner, right.outer)}) {
    if (!outer || !inner || in < out) continue;
    table.problem("inner_diameter",
                  fmt::format("found {:g} mm, expected less than the outer diameter "
                              "of {:g} mm",
                              1e3 * in, 1e3 * out));
    break;
  }
}

void read_shear(TableReader& table, ShearCoefficient& to) {
  const ConfigNode* shear = table.node("shear_coefficient");
  if (shear && shear->kind == ConfigNode::Kind::string) {
    if (const auto formula = table.choice<ShearFormula>("shear_coefficient")) {
      to.formula = *formula;
    }
  } else if (shear) {
    to.formula = ShearFormula::given;
    if (const auto value = table.quantity("shear_coefficient", "", Range::positive)) {
      to.value = *value;
    }
  }
}

void read_rayleigh(ModelReading& reading, TableReader& table, Rayleigh& to) {
  TableReader rayleigh = reading.inner(table, "rayleigh");
  rayleigh.read(to);
  rayleigh.finish();
}

std::optional<Unbalance> read_unbalance(TableReader& table, const Station& at,
                                        std::optional<double> mass) {
  const auto offset = table.quantity("offset", "m", Range::nonnegative);
  const auto moment = table.quantity("moment", "kg.m", Range::nonnegative);
  const auto phase = table.quantity("phase", "rad", Range::any);
  Unbalance u{.at = at, .phase = phase.value_or(0.0)};
  const char* expected = "one of moment (kg.m) and offset (m, of a disk or body with a mass)";
  if (!table.has("offset") && !table.has("moment")) {
    table.missing("moment", expected, {"offset"});
    return std::nullopt;
  }
  if (table.has("offset") && table.has("moment")) {
    table.problem("offset", fmt::format("found both, expected {}", expected));
    return std::nullopt;
  }
  if (moment) u.moment = *moment;
  if (offset && !mass) {
    table.problem("offset", "an offset needs a mass: give moment (kg.m) instead");
    return std::nullopt;
  }
  if (offset) u.moment = *offset * *mass;
  return u;
}

Vec2 read_center(TableReader& table) {
  const auto offset = table.pair("offset", "m", Range::any, "[x, y]");
  return offset ? Vec2(offset->front(), offset->back()) : Vec2(Vec2::Zero());
}

void need_tilts(const ModelReading& reading, TableReader& table, const char* key,
                const Station& at) {
  const Body* body = reading.body_at(at);
  if (body && !body->tilts) table.problem(key, "this body does not tilt; give it tilts = true");
}

Beginning read_beginning(TableReader& table) {
  const auto text = table.string("begins");
  if (!text) return {};
  const auto quantity = parse_quantity(*text);
  const bool is_time = quantity && quantity->dimension == dimension_of("s");
  const bool is_turn = quantity && quantity->dimension == dimension_of("rad");
  if (!(is_time || is_turn) || !(quantity->value > 0.0)) {
    table.problem("begins", fmt::format("found {}, expected a time or revolutions after the start "
                                        "of the recording, such as \"0.5 s\" or \"20 rev\"",
                                        in_quotes(*text)));
    return {};
  }
  if (is_time) return {.time = quantity->value};
  return {.revolutions = quantity->value / (2.0 * std::numbers::pi)};
}

}  // namespace whirl::inline io
