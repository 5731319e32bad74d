#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libfe/analyses/critical_map.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Numbers on the axis of the stiffness in one of the map.
double per_stiffness(const CriticalMap& map) {
  return map.is_common ? 1.0 / shown_unit("N/m").size : 1.0;
}

/// Branches of the map, named by their sense and their number among those of this sense.
std::vector<Curve> branch_curves(const CriticalMap& map) {
  std::map<Whirl, int> seen;
  std::vector<Curve> curves;
  for (const CriticalMapBranch& branch : map.branches) {
    const WhirlStyle style = whirl_style(branch.whirl);
    const std::string name = fmt::format("{}{}", ++seen[branch.whirl], style.letter);
    Curve c{.name = style.name, .paint = style.paint};
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      if (!std::isfinite(branch.speed[i])) continue;
      c.x.push_back(per_stiffness(map) * map.x[i]);
      c.y.push_back(branch.speed[i] / speed_unit().size);
    }
    // those that leave the picture at its top would have their names there, upon each other
    if (!c.y.empty() && c.y.back() <= map.top / speed_unit().size) c.end_name = name;
    c.width = 1.8;
    c.dash = style.dash;
    c.has_marker = true;
    c.marker = style.marker;
    c.marker_every = 6;
    curves.push_back(std::move(c));
  }
  return curves;
}

/// Stiffness of the bearings over speed, and where it crosses the critical speeds of the map.
void draw_bearings(const CriticalMap& map, Panel& p) {
  Curve crossings{.name = "crossings", .paint = Paint::ink, .has_line = false};
  crossings.has_marker = true;
  crossings.marker = Marker::cross;
  crossings.size = 9.0;
  std::size_t number = 0;
  for (const StiffnessCurve& stiffness : map.curves) {
    Curve c{.name = stiffness.name, .paint = series_paint(number + 1)};
    c.dash = series_dash(number++);
    c.width = 1.4;
    for (const double k : stiffness.stiffness)
      c.x.push_back(k > 0.0 ? per_stiffness(map) * k : std::nan(""));
    c.y = scaled(map.curve_speeds, 1.0 / speed_unit().size);
    p.curves.push_back(std::move(c));
  }
  for (const StiffnessCrossing& at : map.crossings) {
    crossings.x.push_back(per_stiffness(map) * at.stiffness);
    crossings.y.push_back(at.speed / speed_unit().size);
    crossings.hover.push_back(fmt::format("{}: {} at {}", map.curves[at.curve].name,
                                          name_of(map.branches[at.branch].whirl),
                                          shown_value(at.speed, "rpm", ".1f")));
  }
  p.curves.push_back(std::move(crossings));
}

void add_gaps(const CriticalMap& map, Figure& f) {
  constexpr std::size_t most = 3;  // told one by one
  for (std::size_t i = 0; i < std::min(most, map.gaps.size()); ++i) {
    const double at = map.gaps[i].x;
    f.notes.push_back(
        fmt::format("Left out at {}: {}.",
                    map.is_common ? shown_value(at, "N/m", ".4g") : fmt::format("{:.4g}", at),
                    map.gaps[i].why));
  }
  if (map.gaps.size() > most) {
    f.notes.push_back(fmt::format("Left out likewise at {} more.", map.gaps.size() - most));
  }
}

FigureTable table_of(const std::vector<Critical>& criticals) {
  FigureTable table{
      .header = {shown_heading("critical speed", "rpm"), "whirl", shown_heading("damped", "rpm")}};
  for (const Critical& c : criticals) {
    table.rows.push_back(
        {shown_number(c.speed, "rpm", ".1f"), std::string(name_of(c.whirl)),
         std::isfinite(c.damped_speed) ? shown_number(c.damped_speed, "rpm", ".1f") : "-"});
  }
  return table;
}

/// Without one in the file: it is of a version that drew what it had solved.
CriticalMap map_of(const ResultView& result, const CriticalSpeeds& found) {
  if (result.file.has(std::string(CriticalMap::group))) return result_of<CriticalMap>(result);
  return critical_map_of(result.assembler->structure(), found);
}

std::vector<Figure> critical_figures(const ResultView& result) {
  const auto& found = result_of<CriticalSpeeds>(result);
  const CriticalMap map = map_of(result, found);
  if (map.branches.empty()) return {};
  Figure f{.height = 500.0};
  f.subtitle =
      fmt::format("Undamped critical speeds of order {:g} over bearing stiffness", found.order);
  Panel p;
  p.x = {.title = map.is_common ? shown_heading("stiffness of each bearing", "N/m")
                                : "stiffness of the bearings, times",
         .scale = Scale::logarithmic};
  p.y = {.title = shown_heading("critical speed", "rpm"), .scale = Scale::logarithmic};
  p.curves = branch_curves(map);
  double low = map.top / speed_unit().size;
  for (const Curve& c : p.curves) {
    for (const double speed : c.y) low = std::min(low, speed);
  }
  const Axis shown = axis_around({low, map.top / speed_unit().size}, Scale::logarithmic);
  constexpr double room = 1.3;  // above the highest crossing
  double highest = map.top;
  for (const StiffnessCrossing& at : map.crossings) highest = std::max(highest, at.speed);
  p.y.first = shown.first;
  p.y.last = room * highest / speed_unit().size;
  f.notes.push_back(fmt::format("Above {} some critical speeds are left out.",
                                shown_value(map.top, "rpm", ".0f")));
  f.notes.push_back(
      "Names count the branches of each sense of whirl: 2F is the second forward one.");
  if (map.is_common) {
    draw_bearings(map, p);
    if (!map.curves.empty()) {
      f.notes.push_back(
          "Curves of bearings are their direct stiffness; critical speeds of the table are those "
          "with all coefficients.");
    }
  } else {
    p.rules.push_back({Rule::Kind::vertical, 1.0, "of the model", Paint::gray, Dash::dashed});
  }
  const double speed = speed_of(result) / speed_unit().size;
  if (std::isfinite(speed) && speed > 0.0) {
    p.rules.push_back({Rule::Kind::horizontal, speed, "operating", Paint::gray, Dash::dotted});
  }
  if (!map.swept.empty()) {
    f.notes.push_back(fmt::format("{} of: {}; all else stays as it is in the model.",
                                  map.is_common ? "Stiffness" : "Times the stiffness", map.swept));
  }
  add_gaps(map, f);
  f.table = table_of(found.criticals);
  f.panels.push_back(std::move(p));
  return {f};
}

}  // namespace

FigureKind critical_map_kind() {
  return {
      .name = "critical_map",
      .title = "Critical speeds",
      .summary = "critical speeds over the stiffness of the bearings",
      .needs = {dataset_of<CriticalSpeeds>(&Critical::speed)},
      .needs_model = true,
      .make = critical_figures,
  };
}

}  // namespace whirl::inline io
