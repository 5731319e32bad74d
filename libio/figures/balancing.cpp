#include "libdata/balancing/balancing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// A line from the middle to a point, with a marker there.
Curve arrow(const std::string& name, Complex to, Paint paint, Dash dash, Marker marker) {
  Curve c{.name = name, .paint = paint, .x = {0.0, to.real()}, .y = {0.0, to.imag()}};
  c.dash = dash;
  c.width = 1.8;
  c.has_marker = true;
  c.marker = marker;
  c.size = 6.0;
  return c;
}

/// A panel of vectors on the rotor: a circle with the direction of the mark to the right.
Panel vector_panel(double reach, const std::string& unit) {
  Panel p;
  p.has_equal_scales = true;
  p.x.title = fmt::format("towards the mark [{}]", unit);
  p.y.title = fmt::format("90° with rotation [{}]", unit);
  p.x.first = p.y.first = -1.35 * reach;
  p.x.last = p.y.last = 1.35 * reach;
  p.rules = {{Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::solid},
             {Rule::Kind::vertical, 0.0, "", Paint::gray, Dash::solid}};
  return p;
}

std::string convention_note(const BalancingConvention& c) {
  return fmt::format(
      "Drawn counter-clockwise with rotation. Phases in the table {} the mark, angles count {} "
      "from "
      "it; amplitudes are {}.",
      c.phase == PhaseSense::lead ? "lead" : "lag behind", name_of(c.angles),
      name_of(c.amplitudes));
}

/// Readings of one unit at one speed, before and after.
Figure readings_figure(const Balancing& found, const std::vector<const ReadingBalance*>& rows) {
  const ReadingBalance& first = *rows.front();
  Figure f{.variant = fmt::format("{:.0f} rpm, {}", first.speed / rpm, first.unit),
           .width = 640.0,
           .height = 600.0};
  f.subtitle = fmt::format("1X at {}: before, and as predicted after",
                           shown_value(first.speed, "rpm", ".6g"));
  f.table.header = {"probe",     "before [" + first.unit + "]",
                    "phase [°]", "after [" + first.unit + "]",
                    "phase [°]", "allowed [" + first.unit + "]"};
  double reach = 0.0, allowed = 0.0;
  for (const ReadingBalance* r : rows) {
    reach = std::max({reach, r->told_before, r->told_after});
    if (std::isfinite(r->allowed)) allowed = std::max(allowed, r->allowed);
  }
  Panel p = vector_panel(std::max(reach, allowed), first.unit);
  if (allowed > 0.0) {
    Curve limit = circle("allowed", allowed);
    limit.paint = Paint::alarm;
    limit.dash = Dash::dashed;
    p.curves.push_back(std::move(limit));
  }
  std::size_t number = 0;
  for (const ReadingBalance* r : rows) {
    const double factor = found.convention.per_peak() / r->per_unit;
    const Paint paint = series_paint(number);
    const auto marker = static_cast<Marker>(number++ % markers);
    p.curves.push_back(
        arrow(r->probe + ", before", factor * r->before, paint, Dash::dashed, marker));
    p.curves.push_back(arrow(r->probe + ", after", factor * r->after, paint, Dash::solid, marker));
    p.labels.push_back(label_outwards(factor * r->before, r->probe));
    f.probes.push_back(r->probe);
    f.table.rows.push_back(
        {r->probe, fmt::format("{:.4g}", r->told_before), fmt::format("{:.0f}", r->phase_before),
         fmt::format("{:.4g}", r->told_after), fmt::format("{:.0f}", r->phase_after),
         std::isfinite(r->allowed) ? fmt::format("{:.4g}", r->allowed) : "–"});
  }
  f.panels.push_back(std::move(p));
  f.notes = {convention_note(found.convention)};
  return f;
}

/// Weights of all planes, with what goes into holes.
Figure weights_figure(const Balancing& found) {
  Figure f{.variant = "weights"};
  const ShownUnit unit = shown_unit("g");
  const double per_kg = 1.0 / unit.size;
  f.subtitle = "Weights to add";
  f.table.header = {"plane", shown_heading("mass", "g"), "angle [°]"};
  for (std::size_t k = 0; k < found.planes.size(); ++k) {
    const PlaneBalance& plane = found.planes[k];
    double reach = per_kg * std::max(std::abs(plane.weight), std::abs(plane.placed));
    Curve holes{.name = "in a hole", .paint = Paint::ink, .has_line = false};
    holes.has_marker = true;
    holes.marker = static_cast<Marker>(1);
    for (const HoleBalance& hole : found.holes) {
      if (hole.plane != static_cast<int>(k)) continue;
      const Complex at = per_kg * found.convention.weight(hole.mass, hole.angle * degree);
      reach = std::max(reach, std::abs(at));
      holes.x.push_back(at.real());
      holes.y.push_back(at.imag());
      holes.hover.push_back(
          fmt::format("{:.4g} {} at {:.1f}°", per_kg * hole.mass, unit.name, hole.angle));
    }
    Panel p = vector_panel(reach, unit.name);
    p.title = plane.name;
    p.curves.push_back(
        arrow("weight", per_kg * plane.weight, Paint::forward, Dash::solid, Marker::circle));
    if (!holes.x.empty()) p.curves.push_back(std::move(holes));
    if (std::isfinite(plane.uncertainty)) {
      Curve sure = circle("95 %", per_kg * plane.uncertainty, per_kg * plane.weight.real(),
                          per_kg * plane.weight.imag());
      sure.paint = Paint::gray;
      sure.dash = Dash::dashed;
      p.curves.push_back(std::move(sure));
    }
    p.labels.push_back(label_outwards(
        per_kg * plane.placed,
        fmt::format("{:.4g} {} at {:.0f}°", per_kg * plane.mass, unit.name, plane.angle)));
    f.panels.push_back(std::move(p));
    f.table.rows.push_back({plane.name, fmt::format("{:.4g}", per_kg * plane.mass),
                            fmt::format("{:.1f}", plane.angle)});
  }
  f.columns = static_cast<int>(std::min<std::size_t>(f.panels.size(), 2));
  const std::size_t lines = (f.panels.size() + 1) / 2;
  f.width = f.columns == 1 ? 560.0 : 900.0;
  f.height = (f.columns == 1 ? 560.0 : 500.0) * static_cast<double>(lines);
  f.notes = {convention_note(found.convention)};
  return f;
}

std::vector<Figure> balancing_figures(const ResultView& result) {
  const auto& found = result_of<Balancing>(result);
  std::vector<std::vector<const ReadingBalance*>> groups;
  for (const ReadingBalance& r : found.readings) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return group.front()->speed == r.speed && group.front()->unit == r.unit;
    });
    if (same == groups.end()) {
      groups.push_back({&r});
    } else {
      same->push_back(&r);
    }
  }
  std::vector<Figure> figures;
  for (const auto& rows : groups) figures.push_back(readings_figure(found, rows));
  figures.push_back(weights_figure(found));
  return figures;
}

}  // namespace

FigureKind balancing_kind() {
  return {
      .name = "balancing",
      .title = "Balancing",
      .summary = "vectors of the vibration before and after, and the weights of the planes",
      .needs = {dataset_of<Balancing>(&ReadingBalance::before)},
      .make = balancing_figures,
  };
}

}  // namespace whirl::inline io
