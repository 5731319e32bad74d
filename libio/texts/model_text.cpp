#include "libio/texts/model_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/names.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/parts/exceeded_tables.hpp"
#include "libio/model/model_doubts.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"
#include "libio/text/terminal.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// Names of contacts or films, each with what it is: "contact seal, contact ring"; empty for none.
std::string names_of(const auto& members, const char* kind) {
  std::string names;
  for (const auto& member : members) {
    names += (names.empty() ? "" : ", ") + named(kind, member.name);
  }
  return names;
}

/// Largest deflection of a bow's table [m].
double largest_deflection(const Bow& bow) {
  double largest = 0.0;
  for (std::size_t i = 0; i < bow.z.size(); ++i) {
    largest = std::max(largest, std::hypot(bow.x[i], bow.y[i]));
  }
  return largest;
}

/// Films that linear analyses have, or leave out.
std::vector<OilFilm> films_of(const Model& model, bool is_linearized) {
  std::vector<OilFilm> films;
  for (const OilFilm& film : model.films) {
    if (film.is_linearized == is_linearized) films.push_back(film);
  }
  return films;
}

/// Which contacts and oil films a linear analysis leaves out; empty: none.
std::string left_out_note(const Model& model) {
  const std::string contacts = names_of(stator_contacts(model.contacts), "contact");
  const std::string films = names_of(films_of(model, false), "oil film");
  if (contacts.empty() && films.empty()) return "";
  return fmt::format("left out: {}{}{}{}", contacts, contacts.empty() || films.empty() ? "" : ", ",
                     films,
                     films.empty() ? "" : " (linearize = false: nothing holds the rotor there)");
}

/// What a rotor at rest leans on, and its closest clearances.
std::string rest_text(const ModelFacts& facts) {
  if (!facts.no_rest.empty()) return fmt::format("\n  at rest: {}\n", facts.no_rest);
  std::string text;
  if (!facts.bearing_loads.empty()) {
    text += "\n" + table_of(facts.bearing_loads,
                            {shown("bearing").as("load at rest of"),
                             shown("fx", "N", ".1f").as("x"), shown("fy", "N", ".1f").as("y")});
  }
  if (!facts.clearances.empty()) {
    constexpr std::size_t most = 8;
    std::vector<RunningClearance> closest = facts.clearances;
    if (closest.size() > most) closest.resize(most);
    text += "\n" + table_of(closest, {shown("name").as("closest clearances at rest"),
                                      shown("clearance", "mm", ".4f"),
                                      shown("distance", "mm", ".4f").as("displaced"),
                                      shown("left", "mm", ".4f")});
    const bool has_bearing = std::ranges::any_of(closest, [](const RunningClearance& c) {
      return c.name.starts_with("bearing") || c.name.starts_with("seal");
    });
    if (has_bearing) {
      text +=
          "  in bearings and seals the displacement is the load over the stiffness of their "
          "coefficients,\n  no place of a journal in its film\n";
    }
  }
  return text;
}

/// "2, of 4 and 6 states"
std::string supports_text(const std::vector<Support>& supports) {
  std::vector<int> states;
  for (const Support& support : supports) states.push_back(support.law.states());
  return fmt::format("{}, of {} states", supports.size(), fmt::join(states, " and "));
}

/// How a support was fitted, and what it does that no passive one does.
std::string fit_text(const LawFit& fit) {
  constexpr double rounding = 1e-9;  // of a stiffness
  std::string text = fmt::format("{} poles, within {:.1g}", fit.poles, fit.error);
  if (fit.mirrored > 0) text += fmt::format(", {} made stable", fit.mirrored);
  return text +
         (fit.least_damping < -rounding
              ? fmt::format(", not passive at {}", shown_value(fit.least_damping_at, "Hz", ".4g"))
              : ", passive");
}

}  // namespace

std::string headline(std::string_view what, const Model& model) {
  return std::string(what) + (model.title.empty() ? "" : ": " + shown_line(model.title)) + "\n";
}

std::string text_of(const ModelFacts& facts, const Model& model) {
  const Structure& s = model.structure;
  Table table({"what", "value"});
  table.row({"mass of the rotor", format_engineering(facts.mass, "kg")});
  if (facts.center_of_mass) {
    table.row({"length", format_length(facts.length)});
    table.row({"center of mass at", format_length(*facts.center_of_mass)});
  }
  table.row({"polar moment of inertia", format_engineering(facts.polar_inertia, "kg.m^2")});
  if (facts.transverse_inertia) {
    table.row({"transverse moment of inertia about the center",
               format_engineering(*facts.transverse_inertia, "kg.m^2")});
  }
  for (const Structure::Shaft& shaft : s.shafts()) {
    if (shaft.name.empty()) continue;
    table.row(
        {"rotor " + shaft.name,
         fmt::format("{}{}",
                     !shaft.has_own_speed() ? fmt::format("{:.6g} times the speed", shaft.ratio)
                     : shaft.rotor->own.size() == 1 ? format_speed(shaft.rotor->own.front())
                                                    : std::string("speeds of a table"),
                     shaft.segments.empty() ? ""
                                            : fmt::format(", {} to {}", format_length(shaft.start),
                                                          format_length(shaft.end())))});
  }
  table.row({"nodes, bodies", fmt::format("{}, {}", facts.nodes, s.bodies.size())});
  table.row({"degrees of freedom",
             facts.condensed_dofs > 0 ? fmt::format("{}, of which {} without inertia are condensed",
                                                    facts.dofs, facts.condensed_dofs)
                                      : fmt::format("{}", facts.dofs)});
  table.row({"disks, bearings, links",
             fmt::format("{}, {}, {}", s.disks.size(), s.bearings.size(), s.links.size())});
  if (!s.seals.empty()) table.row({"seals", fmt::format("{}", s.seals.size())});
  if (!s.gears.empty()) table.row({"gears", fmt::format("{}", s.gears.size())});
  if (!s.supports.empty()) table.row({"supports", supports_text(s.supports)});
  for (const Support& support : s.supports) {
    if (support.fit) table.row({support.name, fit_text(*support.fit)});
  }
  if (!s.layers.empty()) table.row({"layers", fmt::format("{}", s.layers.size())});
  if (!s.forces.empty()) table.row({"forces", fmt::format("{}", s.forces.size())});
  if (!s.bow.z.empty()) {
    table.row({"bow", format_length(largest_deflection(s.bow)) + " at most"});
  }
  for (const Rotor& rotor : s.rotors) {
    if (rotor.bow.z.empty()) continue;
    table.row({"bow of " + rotor.name, format_length(largest_deflection(rotor.bow)) + " at most"});
  }
  if (!model.films.empty()) table.row({"oil films", fmt::format("{}", model.films.size())});
  if (const auto rolling = rolling_bearings(model.contacts).size(); rolling > 0) {
    table.row({"rolling bearings", fmt::format("{}", rolling)});
  }
  table.row({"contacts", fmt::format("{}", stator_contacts(model.contacts).size())});
  table.row({"operating speed", model.has_speed ? format_speed(model.speed) : "not given"});
  return table.text() + rest_text(facts);
}

std::vector<std::string> table_notes(const Structure& structure,
                                     const std::vector<double>& speeds) {
  const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
  const double lowest = *low, highest = *high;
  std::vector<ExceededTable> tables;  // one of each range, with all names
  for (const ExceededTable& table : exceeded_tables(structure, lowest, highest)) {
    const auto same = std::find_if(tables.begin(), tables.end(), [&](const ExceededTable& t) {
      return t.first == table.first && t.last == table.last;
    });
    if (same == tables.end()) {
      tables.push_back(table);
    } else {
      same->name += ", " + table.name;
    }
  }
  std::vector<std::string> notes;
  for (const ExceededTable& table : tables) {
    std::string beyond;
    if (lowest < table.first) {
      beyond = fmt::format("below (asked: {})", shown_value(lowest, "rpm", ".6g"));
    }
    if (highest > table.last) {
      beyond += fmt::format("{}above (asked: {})", beyond.empty() ? "" : " and ",
                            shown_value(highest, "rpm", ".6g"));
    }
    notes.push_back(fmt::format("the table of {} goes from {} to {}; its ends are held constant {}",
                                table.name, shown_number(table.first, "rpm", ".6g"),
                                shown_value(table.last, "rpm", ".6g"), beyond));
  }
  return notes;
}

std::vector<std::string> frequency_notes(const Structure& structure) {
  std::string names;
  for (const auto& [kind, list] : structure.connections()) {
    for (const Connection& c : list) {
      if (!depends_on_whirl(c.coefficients) || c.is_clamped) continue;
      names += (names.empty() ? "" : ", ") + named(kind, c.name);
    }
  }
  if (names.empty()) return {};
  return {
      fmt::format("coefficients of {} depend on the whirl frequency; the motion is computed "
                  "with those at which it is the speed",
                  names)};
}

std::vector<std::string> left_out_notes(const Model& model, const std::vector<double>& speeds) {
  std::vector<std::string> notes = table_notes(model.structure, speeds);
  const std::string left_out = left_out_note(model);
  if (!left_out.empty()) notes.insert(notes.begin(), left_out);
  return notes;
}

std::vector<std::string> film_notes(const Model& model) {
  const std::string films = names_of(films_of(model, true), "oil film");
  const std::string rolling = names_of(rolling_bearings(model.contacts), "rolling bearing");
  if (films.empty() && rolling.empty()) return {};
  return {"linearized about the static equilibrium at each speed: " + films +
          (films.empty() || rolling.empty() ? "" : ", ") + rolling};
}

std::vector<std::string> speed_notes(const Model& model) {
  const std::string doubt = speed_doubt(model);
  return doubt.empty() ? std::vector<std::string>{} : std::vector{doubt};
}

std::vector<std::string> linear_notes(const Model& model, const std::vector<double>& speeds) {
  std::vector<std::string> notes = film_notes(model);
  for (std::string& note : left_out_notes(model, speeds)) notes.push_back(std::move(note));
  for (std::string& note : speed_notes(model)) notes.push_back(std::move(note));
  return notes;
}

}  // namespace whirl::inline io
