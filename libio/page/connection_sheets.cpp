#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/names.hpp"
#include "libio/page/part_sheets.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

/// A matrix of coefficients as columns of a table.
struct MatrixColumns {
  const char* letter;  ///< "k" of kxx
  const char* unit;
  Mat2 BearingCoefficients::*matrix;
  bool is_optional;  ///< left out where it is zero
};
const std::array<MatrixColumns, 5> matrices{{{"k", "MN/m", &BearingCoefficients::K, false},
                                             {"c", "kN.s/m", &BearingCoefficients::C, false},
                                             {"kθ", "kN.m/rad", &BearingCoefficients::Kt, true},
                                             {"cθ", "kN.m.s/rad", &BearingCoefficients::Ct, true},
                                             {"m", "kg", &BearingCoefficients::M, true}}};

/// Coefficients of a connection, row by row as they were told.
struct Rows {
  std::vector<BearingCoefficients> rows;
  std::span<const double> speeds{}, whirls{};
};

Rows rows_of(const AnyBearing& bearing) {
  Rows told{{}, told_speeds(bearing), told_whirls(bearing)};
  for (std::size_t i = 0; i < std::max(told.speeds.size(), told.whirls.size()); ++i) {
    const double whirl = told.whirls.empty() ? told.speeds[i] : told.whirls[i];
    told.rows.push_back(coefficients(bearing, told.speeds.empty() ? whirl : told.speeds[i], whirl));
  }
  if (told.rows.empty()) told.rows.push_back(coefficients(bearing, 0.0));
  return told;
}

FigureTable coefficient_table(const Rows& told) {
  FigureTable table;
  table.rows.resize(told.rows.size());
  const auto add = [&](const std::string& heading, const auto& value) {
    table.header.push_back(heading);
    for (std::size_t i = 0; i < told.rows.size(); ++i) table.rows[i].push_back(value(i));
  };
  if (!told.speeds.empty()) {
    add(shown_heading("speed", "rpm"),
        [&](std::size_t i) { return shown_digits(told.speeds[i], "rpm"); });
  }
  if (!told.whirls.empty()) {
    add(shown_heading("whirl", "rpm"),
        [&](std::size_t i) { return shown_digits(told.whirls[i], "rpm"); });
  }
  for (const MatrixColumns& m : matrices) {
    const bool is_zero = std::all_of(told.rows.begin(), told.rows.end(),
                                     [&](const auto& row) { return (row.*m.matrix).isZero(0.0); });
    if (m.is_optional && is_zero) continue;
    for (const auto& [name, i, j] :
         {std::tuple{"xx", 0, 0}, {"xy", 0, 1}, {"yx", 1, 0}, {"yy", 1, 1}}) {
      add(shown_heading(fmt::format("{}{}", m.letter, name), m.unit),
          [&, i = i, j = j](std::size_t row) {
            return shown_digits((told.rows[row].*m.matrix)(i, j), m.unit);
          });
    }
  }
  return table;
}

/// Connections of one kind that have the same coefficients.
struct Alike {
  const char* kind;
  std::vector<const Connection*> members;
};

std::vector<Alike> alike(const Structure& s) {
  std::vector<Alike> groups;
  for (const Structure::Connections& of_kind : s.connections()) {
    for (const Connection& c : of_kind.list) {
      const auto same = std::find_if(groups.begin(), groups.end(), [&](const Alike& group) {
        const Connection& first = *group.members.front();
        return group.kind == of_kind.kind && first.coefficients == c.coefficients &&
               first.is_rigid == c.is_rigid && first.is_clamped == c.is_clamped;
      });
      if (same != groups.end()) {
        same->members.push_back(&c);
      } else {
        groups.push_back({of_kind.kind, {&c}});
      }
    }
  }
  return groups;
}

/// Where connections are, and what they leave to the rotor.
Sheet places_sheet(const ModelParts& parts) {
  FigureTable table{.header = {"name", "kind", shown_heading("at z", "mm"), "against",
                               "coefficients", shown_heading("radial clearance", "mm")}};
  for (const auto& [kind, list] : parts.structure.connections()) {
    for (const Connection& c : list) {
      const char* how = c.is_clamped                       ? "rigid, tilts too"
                        : c.is_rigid                       ? "rigid"
                        : depends_on_whirl(c.coefficients) ? "over whirl frequency"
                        : depends_on_speed(c.coefficients) ? "over speed"
                                                           : "constant";
      table.rows.push_back({c.name, kind, z_text(c.from, parts), z_text(c.to, parts), how,
                            c.clearance > 0.0 ? shown_digits(c.clearance, "mm") : "not told"});
    }
  }
  Sheet sheet{"Bearings, seals and links", table};
  tell_common(sheet, 3);
  return sheet;
}

Sheet coefficients_sheet(const Alike& group) {
  std::string names;
  for (const Connection* c : group.members) {
    names += (names.empty() ? "" : ", ") + named(group.kind, c->name);
  }
  const Rows told = rows_of(group.members.front()->coefficients);
  Sheet sheet{"Coefficients: " + names, coefficient_table(told)};
  if (told.rows.size() > 1) {
    sheet.notes.push_back(
        "Between the rows: interpolated, as the model says; beyond the first and the last row: "
        "held "
        "constant.");
  }
  return sheet;
}

Sheet gears_sheet(const ModelParts& parts) {
  const auto degrees = [](double angle) { return shown_digits(angle, "deg"); };
  return {
      "Gears",
      sheet_table(
          parts.structure.gears,
          {{"gears", [](const GearPair& g) { return g.name; }},
           {"driving at z", [&](const GearPair& g) { return z_text(g.driving, parts); }},
           {"driven at z", [&](const GearPair& g) { return z_text(g.driven, parts); }},
           {shown_heading("pitch radii", "mm"),
            [](const GearPair& g) {
              return shown_digits(g.driving_radius, "mm") + ", " +
                     shown_digits(g.driven_radius, "mm");
            }},
           {shown_heading("centers", "deg"), [&](const GearPair& g) { return degrees(g.centers); }},
           {shown_heading("pressure angle", "deg"),
            [&](const GearPair& g) { return degrees(g.pressure_angle); }},
           {shown_heading("helix angle", "deg"),
            [&](const GearPair& g) { return degrees(g.helix_angle); }},
           {shown_heading("k", "MN/m"),
            [](const GearPair& g) { return shown_digits(g.stiffness, "MN/m"); }},
           {shown_heading("c", "kN.s/m"),
            [](const GearPair& g) { return shown_digits(g.damping, "kN.s/m"); }}})};
}

Sheet supports_sheet(const ModelParts& parts) {
  const auto places = [&](const Support& support) {
    std::string text;
    for (const Station* at : places_of(support))
      text += (text.empty() ? "" : ", ") + z_text(*at, parts);
    return text;
  };
  return {"Supports with a dynamic stiffness",
          sheet_table(
              parts.structure.supports,
              {{"support", [](const Support& s) { return s.name; }},
               {"at z", places},
               {"coordinates", [](const Support& s) { return std::to_string(s.acts_on.size()); }},
               {"states", [](const Support& s) { return std::to_string(s.law.states()); }},
               {shown_heading("k at rest", "MN/m"), [](const Support& s) {
                  return shown_digits(s.law.static_stiffness()(0, 0), "MN/m");
                }}})};
}

Sheet films_sheet(const ModelParts& parts) {
  return {"Oil films",
          sheet_table(
              parts.model.films,
              {{"film", [](const OilFilm& f) { return f.name; }},
               {shown_heading("at z", "mm"), [&](const OilFilm& f) { return z_text(f.at, parts); }},
               {"against", [&](const OilFilm& f) { return z_text(f.against, parts); }},
               {"law",
                [](const OilFilm& f) {
                  return std::string(std::visit([](const auto& law) { return law.name; }, f.law));
                }},
               {shown_heading("radius", "mm"),
                [](const OilFilm& f) { return shown_digits(f.bearing.radius, "mm"); }},
               {shown_heading("length", "mm"),
                [](const OilFilm& f) { return shown_digits(f.bearing.length, "mm"); }},
               {shown_heading("radial clearance", "um"),
                [](const OilFilm& f) { return shown_digits(f.bearing.clearance, "um"); }},
               {shown_heading("viscosity", "mPa.s"),
                [](const OilFilm& f) { return shown_digits(f.bearing.viscosity, "mPa.s"); }},
               {"in linear analyses",
                [](const OilFilm& f) { return f.is_linearized ? "linearized" : "left out"; }}})};
}

Sheet rolling_sheet(const ModelParts& parts) {
  const auto row = [](const Contact& c) -> const auto& {
    return *rolling_elements(c.geometry);
  };
  return {"Rolling bearings",
          sheet_table(
              rolling_bearings(parts.model.contacts),
              {{"bearing", [](const Contact& c) { return c.name; }},
               {shown_heading("at z", "mm"), [&](const Contact& c) { return z_text(c.at, parts); }},
               {"against", [&](const Contact& c) { return z_text(c.against, parts); }},
               {"elements", [=](const Contact& c) { return std::to_string(row(c).elements); }},
               {shown_heading("radial play", "um"),
                [=](const Contact& c) { return shown_digits(row(c).play, "um"); }},
               {"cage over shaft", [=](const Contact& c) { return five_digits(row(c).cage); }},
               {"law of an element", [](const Contact& c) {
                  return std::string(std::visit([](const auto& law) { return law.name; }, c.law));
                }}})};
}

}  // namespace

std::vector<Sheet> connection_sheets(const ModelParts& parts) {
  std::vector<Sheet> sheets;
  const std::vector<Alike> groups = alike(parts.structure);
  if (!groups.empty()) sheets.push_back(places_sheet(parts));
  for (const Alike& group : groups) {
    if (!group.members.front()->is_rigid) sheets.push_back(coefficients_sheet(group));
  }
  if (!parts.structure.gears.empty()) sheets.push_back(gears_sheet(parts));
  if (!parts.structure.supports.empty()) sheets.push_back(supports_sheet(parts));
  if (!parts.model.films.empty()) sheets.push_back(films_sheet(parts));
  if (!rolling_bearings(parts.model.contacts).empty()) sheets.push_back(rolling_sheet(parts));
  return sheets;
}

}  // namespace whirl::inline io
