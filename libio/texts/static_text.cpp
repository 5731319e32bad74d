#include "libio/texts/static_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// Where the nominal stresses are largest.
std::string stress_text(const BendingLine& line) {
  if (line.bending_stress.size() == 0) return "";
  Eigen::Index bent = 0, sheared = 0;
  line.bending_stress.maxCoeff(&bent);
  line.shear_stress.maxCoeff(&sheared);
  return fmt::format(
      "  Nominal stresses are at most {} by bending at z = {}, {} by shear at z = {}; steps and\n"
      "  keyways raise them.\n",
      format_engineering(line.bending_stress(bent), "Pa"), shown_value(line.z(bent), "mm", ".1f"),
      format_engineering(line.shear_stress(sheared), "Pa"),
      shown_value(line.z(sheared), "mm", ".1f"));
}

std::string bending_text(const BendingLine& line) {
  if (line.moment.isZero(0.0)) return "";  // no weight, or no shaft
  Eigen::Index largest = 0, lowest = 0;
  line.moment.rowwise().norm().maxCoeff(&largest);
  line.deflection.rowwise().norm().maxCoeff(&lowest);
  return fmt::format("  The shaft bends most at z = {}, by {}, and sags most at z = {}, by {}.\n",
                     shown_value(line.z(largest), "mm", ".1f"),
                     shown_value(line.moment.row(largest).norm(), "N.m", ".4g"),
                     shown_value(line.z(lowest), "mm", ".1f"),
                     shown_value(line.deflection.row(lowest).norm(), "um", ".3f")) +
         stress_text(line);
}

std::string films_text(const std::vector<RunningFilm>& films, double speed) {
  if (films.empty()) return "";
  const auto part = [](const char* name, const char* unit, Mat2 RunningFilm::*of, int i, int j) {
    return TableColumn<RunningFilm>(shown_heading(name, unit),
                                    [of, unit, i, j](const RunningFilm& f) {
                                      return shown_number((f.*of)(i, j), unit, ".5g");
                                    });
  };
  const auto K = &RunningFilm::stiffness, C = &RunningFilm::damping;
  return fmt::format("\nJournals on their oil films at {}\n\n", shown_value(speed, "rpm", ".6g")) +
         table_of(films,
                  {shown("name").as("oil film"), shown("eccentricity", "", ".5f"),
                   shown("attitude_deg", "", ".3f").as("attitude [deg]"),
                   shown("film", "um", ".3f").as("thinnest"), shown("fx", "N", ".4f").as("load x"),
                   shown("fy", "N", ".4f").as("load y"), shown("sommerfeld", "", ".5g"),
                   shown("power_loss", "W", ".4g").as("power loss")}) +
         "\n" +
         table_of(films, {shown("name").as("oil film"), part("kxx", "N/m", K, 0, 0),
                          part("kxy", "N/m", K, 0, 1), part("kyx", "N/m", K, 1, 0),
                          part("kyy", "N/m", K, 1, 1), part("cxx", "N.s/m", C, 0, 0),
                          part("cxy", "N.s/m", C, 0, 1), part("cyx", "N.s/m", C, 1, 0),
                          part("cyy", "N.s/m", C, 1, 1)}) +
         "\n  The attitude is the angle from the load to the journal, about +z; force = -K u - C "
         "u' about there.\n";
}

std::string rolling_text(const std::vector<RunningBearing>& bearings) {
  if (bearings.empty()) return "";
  const auto part = [](const char* name, int i, int j) {
    return TableColumn<RunningBearing>(shown_heading(name, "N/m"), [i, j](const RunningBearing& b) {
      return shown_number(b.stiffness(i, j), "N/m", ".5g");
    });
  };
  return "\nRolling bearings, their cages where they are at time 0\n\n" +
         table_of(
             bearings,
             {shown("name").as("rolling bearing"), shown("fx", "N", ".4f").as("load x"),
              shown("fy", "N", ".4f").as("load y"), shown("loaded"), shown("largest", "N", ".4f"),
              part("kxx", 0, 0), part("kxy", 0, 1), part("kyy", 1, 1)}) +
         "\n  Loaded: balls or rollers that are pressed; largest: the radial load of the one that "
         "is\n  pressed most; force = -K u about there, kyx = kxy.\n" +
         (std::ranges::any_of(bearings, [](const RunningBearing& b) { return b.loaded == 1; })
              ? "  Where one carries alone, nothing holds the ring across it: another cage_angle "
                "or "
                "less\n  clearance lets two carry.\n"
              : "");
}

}  // namespace

std::string text_of(const StaticStudy& study) {
  std::string text = study.has_forces ? "Static equilibrium under gravity and constant forces\n"
                                      : "Static equilibrium under gravity\n";
  if (!study.has_gravity && !study.has_forces) {
    text += "(the model has no gravity: add gravity = \"9.81 m/s^2\")\n";
  }
  text +=
      "\n" + table_of(study.stations, {{"station", [](const RestingStation& s) { return s.label; }},
                                       {shown_heading("z", "mm"),
                                        [](const RestingStation& s) {
                                          return s.node ? shown_number(s.z, "mm", ".1f") : "";
                                        }},
                                       shown("x", "um", ".3f"),
                                       shown("y", "um", ".3f")});
  text += text_of(study.probes);
  if (!study.at_rest.bearings.empty() ||
      (study.on_films.films.empty() && study.on_elements.bearings.empty())) {
    text += "\n" + table_of(study.at_rest.bearings,
                            {shown("bearing"), shown("fx", "N", ".4f").as("load x"),
                             shown("fy", "N", ".4f").as("load y")});
  }
  if (!study.at_rest.links.empty()) {
    text +=
        "\n" + table_of(study.at_rest.links, {shown("link"), shown("fx", "N", ".4f").as("load x"),
                                              shown("fy", "N", ".4f").as("load y")});
  }
  text += films_text(study.on_films.films, study.speed);
  text += rolling_text(study.on_elements.bearings);
  return text + "\n  A load is the force of the rotor on its bearing; y points up.\n" +
         bending_text(study.line);
}

}  // namespace whirl::inline io
