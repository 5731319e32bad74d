#include "libio/texts/static_text.hpp"

#include <fmt/format.h>

#include "libbase/numerics/constants.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

std::string bending_text(const BendingLine& line) {
  if (line.moment.isZero(0.0)) return "";  // no weight, or no shaft
  Eigen::Index largest = 0, lowest = 0;
  line.moment.rowwise().norm().maxCoeff(&largest);
  line.deflection.rowwise().norm().maxCoeff(&lowest);
  return fmt::format(
      "  The shaft bends most at z = {:.1f} mm, by {:.4g} N.m, and sags most at z = {:.1f} mm, by "
      "{} um.\n",
      1e3 * line.z(largest), line.moment.row(largest).norm(), 1e3 * line.z(lowest),
      texts::number_text(1e6 * line.deflection.row(lowest).norm(), ".3f"));
}

std::string films_text(const std::vector<RunningFilm>& films, double speed) {
  if (films.empty()) return "";
  const auto part = [](const char* name, const char* unit, Mat2 RunningFilm::*of, int i, int j) {
    return TableColumn<RunningFilm>(
        fmt::format("{} [{}]", name, unit),
        [of, i, j](const RunningFilm& f) { return texts::number_text((f.*of)(i, j), ".5g"); });
  };
  const auto K = &RunningFilm::stiffness, C = &RunningFilm::damping;
  return fmt::format("\nJournals on their oil films at {:.6g} rpm\n\n", speed / rpm) +
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

}  // namespace

std::string text_of(const StaticStudy& study) {
  std::string text = study.has_forces ? "Static equilibrium under gravity and constant forces\n"
                                      : "Static equilibrium under gravity\n";
  if (!study.has_gravity && !study.has_forces) {
    text += "(the model has no gravity: add gravity = \"9.81 m/s^2\")\n";
  }
  text +=
      "\n" + table_of(study.stations, {{"station", [](const RestingStation& s) { return s.label; }},
                                       {"z [mm]",
                                        [](const RestingStation& s) {
                                          return s.node ? fmt::format("{:.1f}", 1e3 * s.z) : "";
                                        }},
                                       shown("x", "um", ".3f"),
                                       shown("y", "um", ".3f")});
  text += text_of(study.probes);
  if (!study.at_rest.bearings.empty() || study.on_films.films.empty()) {
    text += "\n" + table_of(study.at_rest.bearings,
                            {shown("bearing"), shown("fx", "N", ".4f").as("load x"),
                             shown("fy", "N", ".4f").as("load y")});
  }
  text += films_text(study.on_films.films, study.speed);
  return text + "\n  A load is the force of the rotor on its bearing; y points up.\n" +
         bending_text(study.line);
}

}  // namespace whirl::inline io
