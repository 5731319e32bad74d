#include "libio/texts/static_text.hpp"

#include <fmt/format.h>

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

}  // namespace

std::string text_of(const StaticStudy& study) {
  std::string text = "Static equilibrium under gravity\n";
  if (!study.has_gravity) {
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
  text += "\n" +
          table_of(study.at_rest.bearings, {shown("bearing"), shown("fx", "N", ".4f").as("load x"),
                                            shown("fy", "N", ".4f").as("load y")});
  return text + "\n  A load is the force of the rotor on its bearing; y points up.\n" +
         bending_text(study.line);
}

}  // namespace whirl::inline io
