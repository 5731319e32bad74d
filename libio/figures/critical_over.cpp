#include "libdyn/linear/critical_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Shafts that excite, the first one first.
std::vector<std::string> exciting_shafts(const CriticalOver& found) {
  std::vector<std::string> shafts{Critical().shaft};
  const auto add = [&](const std::string& shaft) {
    if (shaft.empty() || std::ranges::find(shafts, shaft) != shafts.end()) return;
    shafts.push_back(shaft);
  };
  for (const CriticalOverBranch& branch : found.branches) add(branch.shaft);
  if (!found.own_branches.empty()) add(found.shaft);
  return shafts;
}

std::size_t place_of(const std::string& shaft, const std::vector<std::string>& shafts) {
  return static_cast<std::size_t>(std::ranges::find(shafts, shaft) - shafts.begin());
}

/// "by hp, forward (F)".
std::string exciting_name(const std::string& shaft, const WhirlStyle& style) {
  return fmt::format("by {}, {}", shaft == Critical().shaft ? "the first shaft" : shaft,
                     style.name);
}

void require_values(bool fits) {
  if (!fits) throw FileError("the critical speeds are not of their values");
}

/// Line and markers of a branch over the values. With further shafts the color is of the shaft that
/// excites, the stroke of the sense.
void add_branch(const CriticalOverBranch& branch, std::size_t number, const ShownAxis& axis,
                const std::vector<std::string>& shafts, Panel& p) {
  require_values(branch.speed.size() == std::ssize(axis.values) &&
                 branch.damped_speed.size() == branch.speed.size());
  const WhirlStyle style = whirl_style(branch.whirl);
  Curve c{.name = style.name,
          .end_name = fmt::format("{}{}", number, style.letter),
          .paint = style.paint,
          .x = axis.values};
  c.y = scaled(numbers(branch.speed), 1.0 / speed_unit().size);
  c.width = 1.8;
  c.dash = style.dash;
  if (shafts.size() > 1) {
    c.name = exciting_name(branch.shaft, style);
    c.paint = series_paint(place_of(branch.shaft, shafts));
  }
  Curve damped{.name = "damped", .paint = c.paint, .x = axis.values, .has_line = false};
  damped.y = scaled(numbers(branch.damped_speed), 1.0 / speed_unit().size);
  damped.has_marker = true;
  damped.marker = style.marker;
  damped.size = 5.0;
  damped.marker_every = std::max<std::size_t>(1, axis.values.size() / 12);
  p.curves.push_back(std::move(c));
  p.curves.push_back(std::move(damped));
}

/// Lines along which a further shaft excites, in the plane of both speeds. They run up: names at
/// their ends would lie upon each other.
void add_own_branches(const CriticalOver& found, const ShownAxis& axis,
                      const std::vector<std::string>& shafts, Panel& p) {
  for (const OwnSpeedBranch& branch : found.own_branches) {
    require_values(branch.speed.size() == std::ssize(found.lead_speeds));
    const WhirlStyle style = whirl_style(branch.whirl);
    Curve c{.name = exciting_name(found.shaft, style),
            .paint = series_paint(place_of(found.shaft, shafts))};
    c.x = scaled(numbers(branch.speed), 1.0 / axis.factor);
    c.y = scaled(found.lead_speeds, 1.0 / speed_unit().size);
    c.width = 1.8;
    c.dash = style.dash;
    p.curves.push_back(std::move(c));
  }
}

/// What the model says of the speed of the further shaft, and where it runs.
void add_relation(const ResultView& result, const CriticalOver& found, const ShownAxis& axis,
                  Panel& p) {
  if (!result.model || found.lead_speeds.empty()) return;
  const auto& rotors = result.model->structure.rotors;
  const auto rotor = std::ranges::find(rotors, found.shaft, &Rotor::name);
  if (rotor == rotors.end()) return;
  constexpr int steps = 200;
  const auto shown = [](double speed) { return speed / speed_unit().size; };
  Curve relation{.name = "speeds of the model", .paint = Paint::ink};
  relation.dash = Dash::dash_dot;
  relation.width = 1.2;
  for (int i = 0; i <= steps; ++i) {
    const double lead = found.lead_speeds.back() * i / steps;
    const double x = rotor->speed_at(lead) / axis.factor;
    if (x < p.x.first || x > p.x.last) continue;
    relation.x.push_back(x);
    relation.y.push_back(shown(lead));
  }
  if (!relation.x.empty()) p.curves.push_back(std::move(relation));
  const double operating = speed_of(result), own = rotor->speed_at(operating) / axis.factor;
  if (!(operating > 0.0) || own < p.x.first || own > p.x.last) return;
  Curve point{.name = "operating point", .paint = Paint::alarm};
  point.x = {own};
  point.y = {shown(operating)};
  point.has_line = false;
  point.has_marker = true;
  point.marker = Marker::diamond;
  point.size = 10.0;
  p.curves.push_back(std::move(point));
}

std::vector<Figure> critical_over_figures(const ResultView& result) {
  const auto& found = result_of<CriticalOver>(result);
  const ShownAxis axis = shown_axis(result, dataset_of<CriticalOver>(&OverValues::values));
  Figure f{.height = 480.0};
  f.subtitle = "Critical speeds over " + axis.path;
  Panel p;
  p.x = {.title = axis.title, .first = axis.values.front(), .last = axis.values.back()};
  p.y = {.title = shown_heading("critical speed", "rpm"), .first = 0.0};
  p.cursor = "parameter";
  const std::vector<std::string> shafts = exciting_shafts(found);
  for (std::size_t i = 0; i < found.branches.size(); ++i) {
    add_branch(found.branches[i], i + 1, axis, shafts, p);
  }
  const double speed = speed_of(result) / speed_unit().size;
  if (!found.shaft.empty()) {
    f.height = 560.0;
    f.subtitle = "Critical speeds in the plane of both speeds";
    p.y.title = shown_heading("speed of the first shaft", "rpm");
    p.cursor.clear();
    add_own_branches(found, axis, shafts, p);
    add_relation(result, found, axis, p);
  } else if (std::isfinite(speed) && speed > 0.0) {
    p.rules.push_back({Rule::Kind::horizontal, speed, "operating", Paint::gray, Dash::dotted});
  }
  f.panels = {std::move(p)};
  return {f};
}

}  // namespace

FigureKind critical_over_kind() {
  return {
      .name = "critical_over",
      .title = "Critical speeds over a value",
      .summary = "critical speeds over a value of the model",
      .needs = {dataset_of<CriticalOver>(&CriticalOverBranch::speed)},
      .make = critical_over_figures,
  };
}

}  // namespace whirl::inline io
