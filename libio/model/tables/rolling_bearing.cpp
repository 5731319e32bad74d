#include "libcontact/rolling_bearing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_laws.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

constexpr int fewest_rolling = 3, most_rolling = 200;
constexpr double steepest = 80.0 * degree;  ///< contact angle
constexpr double widest = 90.0 * degree;    ///< spall
constexpr double most_waves = 200.0;        ///< around a race

/// What says how stiff an element is: a number, or what it follows from.
void check_stiffness(TableReader& table, const RollingBearing& b) {
  const bool is_ball = b.kind == ElementKind::ball;
  const std::string_view own = is_ball ? "hertz_stiffness" : "line_stiffness";
  const std::vector<std::string_view> others =
      is_ball ? std::vector<std::string_view>{"line_stiffness", "roller_length"}
              : std::vector<std::string_view>{"hertz_stiffness", "inner_groove", "outer_groove"};
  for (const std::string_view key : others) {
    if (table.has(key)) {
      table.problem(key, fmt::format("goes with kind = \"{}\"", is_ball ? "roller" : "ball"));
    }
  }
  if (table.has(own)) return;
  if (!is_ball) {
    if (!table.has("roller_length")) {
      table.missing(own, "a stiffness (N/m), or the roller_length that it follows from",
                    {"roller_length"});
    }
    return;
  }
  for (const std::string_view key : {"inner_groove", "outer_groove"}) {
    if (!table.has(key)) {
      table.missing(table.has("inner_groove") || table.has("outer_groove") ? key : own,
                    "a Hertz stiffness (N/m^1.5), or inner_groove and outer_groove, the radii of "
                    "the races across their grooves",
                    {std::string(own), "inner_groove", "outer_groove"});
      return;
    }
  }
  if (!table.has("element_diameter") || !table.has("pitch_diameter")) {
    table.missing("element_diameter",
                  "a length (m): the stiffness follows from the diameters of the balls and of "
                  "their pitch circle",
                  {"element_diameter", "pitch_diameter"});
  }
  for (const auto& [key, radius] :
       {std::pair{"inner_groove", b.inner_groove}, std::pair{"outer_groove", b.outer_groove}}) {
    if (radius > 0.0 && b.element_diameter > 0.0 && !(radius > 0.5 * b.element_diameter)) {
      table.problem(key, fmt::format("found {:g} m, expected more than half the element_diameter, "
                                     "{:g} m",
                                     radius, 0.5 * b.element_diameter));
    }
  }
  if (!(b.poisson < 0.5)) {
    table.problem("nu", fmt::format("found {:g}, expected less than 0.5", b.poisson));
  }
}

/// What says how fast the cage turns.
void check_kinematics(TableReader& table, const RollingBearing& b) {
  const bool has_diameters = table.has("pitch_diameter") && table.has("element_diameter");
  if (!has_diameters && !table.has("cage_ratio")) {
    table.missing("pitch_diameter",
                  "pitch_diameter and element_diameter (m), from which the speed of the cage "
                  "follows, or cage_ratio",
                  {"element_diameter", "cage_ratio"});
  }
  if (has_diameters && b.pitch_diameter > 0.0 && !(b.element_diameter < b.pitch_diameter)) {
    table.problem("element_diameter", "is not less than the pitch_diameter");
  }
  const double around = b.elements * b.element_diameter;
  if (has_diameters && b.element_diameter < b.pitch_diameter &&
      around > std::numbers::pi * b.pitch_diameter) {
    table.problem("elements",
                  fmt::format("{} of this diameter do not fit on the pitch circle", b.elements));
  }
  if (b.has_cage_ratio() && !(b.cage_ratio < 1.0)) {
    table.problem("cage_ratio", fmt::format("found {:g}, expected less than 1", b.cage_ratio));
  }
}

void check_bearing(TableReader& table, const RollingBearing& b) {
  if (b.elements > 0 && b.elements < fewest_rolling) {
    table.problem("elements",
                  fmt::format("found {}, expected {} or more", b.elements, fewest_rolling));
  }
  table.at_most("elements", b.elements, most_rolling);
  if (b.contact_angle > steepest) {
    table.problem("contact_angle", fmt::format("found {:g} deg, expected {:g} deg at most",
                                               b.contact_angle / degree, steepest / degree));
  }
  if (table.has("clearance") && table.has("preload")) {
    table.problem("preload", "a bearing has a clearance or a preload: give one of them");
  }
  check_stiffness(table, b);
  check_kinematics(table, b);
}

std::vector<RaceWaves> read_waves(ModelReading& reading, TableReader& table) {
  std::vector<RaceWaves> all;
  reading.for_each_item(
      table, "waves", "a list of { race = ..., order = ..., height = ... }",
      [&](TableReader& item) {
        RaceWaves one;
        item.read(one);
        if (one.order != std::round(one.order) || one.order > most_waves) {
          item.problem("order", fmt::format("found {:g}, expected a whole number up to {:g}",
                                            one.order, most_waves));
        }
        all.push_back(one);
      });
  return all;
}

std::vector<RaceSpall> read_spalls(ModelReading& reading, TableReader& table) {
  std::vector<RaceSpall> all;
  reading.for_each_item(table, "spalls", "a list of { race = ..., width = ..., depth = ... }",
                        [&](TableReader& item) {
                          RaceSpall one;
                          item.read(one);
                          if (one.width > widest) {
                            item.problem("width",
                                         fmt::format("found {:g} deg, expected {:g} deg at most",
                                                     one.width / degree, widest / degree));
                          }
                          all.push_back(one);
                        });
  return all;
}

void read_rolling_bearings(ModelReading& reading) {
  reading.for_each("rolling_bearing", [&](TableReader& table, std::size_t i) {
    const std::string name =
        table.string("name").value_or(fmt::format("rolling bearing {}", i + 1));
    const auto at = reading.station(table);
    const Station against = other_side(reading, table, at);
    RollingBearing bearing;
    table.read(bearing);
    const auto waves = read_waves(reading, table);
    const auto spalls = read_spalls(reading, table);
    const Vec2 offset = read_center(table);
    check_bearing(table, bearing);
    if (!at || bearing.elements < fewest_rolling || bearing.elements > most_rolling) return;
    Contact contact = contact_of(bearing, waves, spalls);
    contact.where = table.where();
    contact.name = name;
    contact.at = *at;
    contact.against = against;
    contact.offset = offset;
    Structure& structure = reading.model.structure;
    structure.stations.push_back(*at);
    if (against.kind == Station::Kind::position) structure.stations.push_back(against);
    if (bearing.damping > 0.0) {
      Connection damper;
      damper.name = name;
      damper.from = *at;
      damper.to = against;
      ConstantBearing coefficients;
      coefficients.C = bearing.damping * Mat2::Identity();
      damper.coefficients = coefficients;
      structure.links.push_back(std::move(damper));
    }
    reading.model.contacts.push_back(std::move(contact));
  });
}

}  // namespace

ModelTable rolling_bearing_table() {
  return {.name = "rolling_bearing",
          .meaning = "ball and roller bearings, whose elements are pressed one by one",
          .read = read_rolling_bearings,
          .example =
              "body = \"b\"\n"
              "elements = 8\n"
              "pitch_diameter = 0.05\n"
              "element_diameter = 0.01\n"
              "hertz_stiffness = 1e10\n",
          .bare = "waves = [{}]\nspalls = [{}]\n",
          .notes = {{"to", "what holds the outer ring: the ground, a body or another shaft",
                     "\"ground\""},
                    {"offset", "[x, y] of the middle of the outer ring", "[0, 0]"},
                    {"waves", "of the races: a list of { race, order, height, angle }"},
                    {"spalls", "of the races: a list of { race, width, depth, angle }"}}};
}

}  // namespace whirl::inline io
