#include "libio/texts/balancing_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

std::string mass_text(double mass) {
  return shown_digits(mass, "g", 4);
}
std::string unbalance_text(double unbalance) {
  return shown_digits(unbalance, "g.mm", 4);
}
std::string size_text(double size) {
  return std::isfinite(size) ? fmt::format("{:.4g}", size) : "-";
}

/// What phases and angles mean, in words.
std::string convention_text(const BalancingConvention& c) {
  return fmt::format(
      "  phases {} the mark; angles on the rotor count {} from the mark;\n"
      "  amplitudes {}\n",
      c.phase == PhaseSense::lead ? "lead" : "lag behind", name_of(c.angles),
      name_of(c.amplitudes));
}

std::string planes_text(const Balancing& found) {
  using P = PlaneBalance;
  const bool has_grade = std::any_of(found.planes.begin(), found.planes.end(),
                                     [](const P& p) { return std::isfinite(p.permissible); });
  TableColumns<P> columns{
      shown("plane"),
      {shown_heading("weight", "g"), [](const P& p) { return mass_text(p.mass); }},
      {"angle [deg]", [](const P& p) { return fmt::format("{:.1f}", p.angle); }},
      {shown_heading("+-", "g"), [](const P& p) { return mass_text(p.uncertainty); }}};
  if (has_grade) {
    columns.push_back(
        {shown_heading("left", "g.mm"), [](const P& p) { return unbalance_text(p.left); }});
    columns.push_back({shown_heading("permitted", "g.mm"),
                       [](const P& p) { return unbalance_text(p.permissible); }});
  }
  return table_of(found.planes, columns);
}

std::string holes_text(const Balancing& found) {
  if (found.holes.empty()) return "";
  using H = HoleBalance;
  return "\nIn the holes\n\n" +
         table_of(
             found.holes,
             TableColumns<H>{
                 {"plane",
                  [&](const H& h) { return found.planes[static_cast<std::size_t>(h.plane)].name; }},
                 {"angle [deg]", [](const H& h) { return fmt::format("{:.1f}", h.angle); }},
                 {shown_heading("mass", "g"), [](const H& h) { return mass_text(h.mass); }}});
}

std::string readings_text(const Balancing& found) {
  using R = ReadingBalance;
  const auto with_phase = [](double size, double phase) {
    return fmt::format("{:.4g} @ {:.0f}", size, phase);
  };
  const bool has_allowed = std::any_of(found.readings.begin(), found.readings.end(),
                                       [](const R& r) { return std::isfinite(r.allowed); });
  TableColumns<R> columns{
      {"probe", [](const R& r) { return r.probe; }},
      shown("speed", "rpm", ".0f"),
      {"unit", [](const R& r) { return r.unit; }},
      {"before @ deg", [=](const R& r) { return with_phase(r.told_before, r.phase_before); }},
      {"after @ deg", [=](const R& r) { return with_phase(r.told_after, r.phase_after); }},
      {"+-", [](const R& r) { return size_text(r.uncertainty); }}};
  if (has_allowed) {
    columns.push_back({"allowed", [](const R& r) {
                         return size_text(r.allowed) + (r.is_too_large() ? " BEYOND" : "");
                       }});
  }
  return "\nVibration, and what is predicted to remain\n\n" + table_of(found.readings, columns);
}

}  // namespace

std::string text_of(const Balancing& found) {
  return fmt::format("Balancing: weights to add, by {}, coefficients of {}\n{}\n{}{}{}",
                     found.criterion == BalancingCriterion::min_max ? "the smallest largest reading"
                                                                    : "least squares",
                     found.is_of_model ? "the model" : "the runs",
                     convention_text(found.convention), planes_text(found), holes_text(found),
                     readings_text(found));
}

}  // namespace whirl::inline io
