#include "libio/figures/bode_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io::figures {

namespace {

/// Adds the phase lag of an amplitude over speed, between -180 and 180 degrees: a line that leaves
/// them comes back at the other edge, at the same speed.
void add_lag(const std::vector<double>& speed, const CMat& a, Eigen::Index i, Curve& c) {
  constexpr double half = 180.0;
  double before = std::nan("");
  c.x.clear();
  const auto add = [&](double x, double y) {
    c.x.push_back(x);
    c.y.push_back(y);
  };
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double now = std::abs(a(i, k)) > 0.0 ? -std::arg(a(i, k)) / degree : std::nan("");
    if (const double step = now - before; std::abs(step) > half) {
      const double edge = step < 0.0 ? half : -half;
      const double share = (edge - before) / (step + 2.0 * edge);
      const double x = speed[at - 1] + share * (speed[at] - speed[at - 1]);
      add(x, edge);
      add(x, not_set);
      add(x, -edge);
    }
    add(speed[at], now);
    before = now;
  }
}

void mark_operation(const ResultView& result, const std::vector<double>& speeds, Panel& panel) {
  const double speed = speed_of(result) / speed_unit().size;
  if (!std::isfinite(speed) || speed < speeds.front() || speed > speeds.back()) return;
  panel.rules.push_back(
      {Rule::Kind::vertical, speed, "operating speed", Paint::gray, Dash::dotted});
}

}  // namespace

void add_reading(const ProbeLabel& probe, const CVec& reading, std::vector<BodeCurves>& to) {
  auto group = std::find_if(to.begin(), to.end(),
                            [&](const BodeCurves& b) { return b.unit.name == probe.unit; });
  if (group == to.end()) group = to.insert(to.end(), {{}, {}, unit_of(probe), {}, {}});
  const auto count = std::ssize(group->names);
  group->names.push_back(probe_name(probe));
  group->probes.push_back(probe.name);
  group->angles.push_back(probe.angle);
  group->a.conservativeResize(count + 1, reading.size());
  group->a.row(count) = reading.transpose();
}

std::vector<Eigen::Index> named_rows(const std::vector<std::string>& stations) {
  std::vector<Eigen::Index> list;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (stations[i].find_first_not_of("0123456789") != std::string::npos) {
      list.push_back(static_cast<Eigen::Index>(i));
    }
  }
  for (std::size_t i = 0; list.empty() && i < stations.size(); ++i) {
    list.push_back(static_cast<Eigen::Index>(i));
  }
  return list;
}

Figure bode_figure(const ResultView& result, const std::vector<double>& speed,
                   const BodeCurves& shown) {
  Figure f{.height = 560.0};
  Panel amplitude, phase;
  for (Panel* p : {&amplitude, &phase}) {
    p->x = {.title = shown_heading("speed", "rpm"), .first = speed.front(), .last = speed.back()};
    p->cursor = "speed";
    mark_operation(result, speed, *p);
  }
  phase.rules.clear();
  amplitude.share = 1.5;
  amplitude.y = {.title = with_unit("amplitude p-p", shown.unit), .first = 0.0};
  phase.y = {.title = "phase lag [deg]", .first = -180.0, .last = 180.0, .step = 90.0};
  for (std::size_t number = 0; number < shown.names.size(); ++number) {
    const auto i = static_cast<Eigen::Index>(number);
    Curve c{.name = shown.names[number], .paint = series_paint(number), .x = speed};
    c.width = 1.8;
    c.dash = series_dash(number);
    Curve lag = c;
    for (Eigen::Index k = 0; k < shown.a.cols(); ++k) {
      c.y.push_back(2.0 * shown.unit.factor * std::abs(shown.a(i, k)));
    }
    add_lag(speed, shown.a, i, lag);
    amplitude.curves.push_back(std::move(c));
    phase.curves.push_back(std::move(lag));
  }
  f.panels = {amplitude, phase};
  return f;
}

namespace {

/// A place in the plane of a polar plot.
struct PolarPlace {
  double x, y;
};

/// @param angle  from +x towards +y [rad]
PolarPlace polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

void add_place(Curve& c, const PolarPlace& place) {
  c.x.push_back(place.x);
  c.y.push_back(place.y);
}

void interrupt(Curve& c) {
  c.x.push_back(not_set);
  c.y.push_back(not_set);
}

/// Ends of radii, over that of the outermost circle.
constexpr double of_lags = 1.1, of_mark = 1.18, end_of_mark = 1.3, of_arrow = 1.56;

/// Circles of amplitudes, radii every 30 degrees with their lag, counted against the rotation from
/// the probe.
void add_polar_grid(const PolarCurve& shown, const Axis& amplitude, Panel& p) {
  Curve grid{.paint = Paint::faint}, rim{.paint = Paint::gray};
  grid.width = rim.width = 1.0;
  constexpr int points = 180;
  const auto circle_of = [&](Curve& c, double radius) {
    for (int i = 0; i <= points; ++i)
      add_place(c, polar(radius, 2.0 * std::numbers::pi * i / points));
    interrupt(c);
  };
  std::vector<Tick> ticks = amplitude.ticks(4);
  std::erase_if(ticks, [](const Tick& t) { return !(t.value > 0.0); });
  for (const Tick& t : ticks) {
    const bool is_last = &t == &ticks.back();
    if (t.value < amplitude.last) circle_of(grid, t.value);
    const PolarPlace at = polar(t.value, shown.angle - 15.0 * degree);
    const std::string unit = is_last ? " " + shown.unit.name : "";
    p.labels.push_back({at.x, at.y, t.label + unit, Anchor::middle, 0.0, 4.0, Paint::gray});
  }
  circle_of(rim, amplitude.last);
  for (int lag = 0; lag < 360; lag += 30) {
    const double angle = shown.angle - lag * degree;
    add_place(grid, polar(0.0, angle));
    add_place(grid, polar(amplitude.last, angle));
    interrupt(grid);
    const PolarPlace at = polar(of_lags * amplitude.last, angle);
    p.labels.push_back({at.x, at.y, fmt::format("{}°", lag), Anchor::middle, 0.0, 4.0});
  }
  p.curves.push_back(std::move(grid));
  p.curves.push_back(std::move(rim));
}

/// The probe outside of the circle, and an arrow along the rotation in a corner away from it.
void add_polar_marks(const PolarCurve& shown, double radius, Panel& p) {
  Curve probe{.name = "probe", .paint = Paint::stator};
  probe.width = 3.0;
  add_place(probe, polar(of_mark * radius, shown.angle));
  add_place(probe, polar(end_of_mark * radius, shown.angle));
  probe.hover.assign(2, shown.mark);
  p.curves.push_back(std::move(probe));
  // its name above the bar, or beside one that stands upright
  const PolarPlace name = polar(0.5 * (of_mark + end_of_mark) * radius, shown.angle);
  const bool is_flat = std::abs(std::cos(shown.angle)) > 0.5;
  p.labels.push_back({name.x, name.y, shown.mark, is_flat ? Anchor::middle : Anchor::start,
                      is_flat ? 0.0 : 9.0, is_flat ? -11.0 : 4.0, Paint::stator});
  const double quarter = 0.5 * std::numbers::pi;
  const double corner = quarter * (std::floor(shown.angle / quarter + 1e-9) + 2.5);  // opposite
  constexpr double half = 12.0 * degree, head = 4.0 * degree;
  Curve arc{.name = "", .paint = Paint::ink}, tip{.paint = Paint::ink};
  for (int i = 0; i <= 20; ++i) {
    add_place(arc, polar(of_arrow * radius, corner - half + 2.0 * half * i / 20.0));
  }
  for (const auto& [r, turn] : {std::pair{of_arrow - 0.035, half},
                                {of_arrow, half + head},
                                {of_arrow + 0.035, half},
                                {of_arrow - 0.035, half}}) {
    add_place(tip, polar(r * radius, corner + turn));
  }
  tip.fill = 1.0;
  tip.width = 1.0;
  p.curves.push_back(std::move(arc));
  p.curves.push_back(std::move(tip));
  const PolarPlace text = polar((of_arrow + 0.16) * radius, corner);
  p.labels.push_back({text.x, text.y, "rotation", Anchor::middle, 0.0, 4.0});
}

/// Places of the loop at a speed; a record may come by at a speed several times.
std::vector<PolarPlace> places_at(const Curve& loop, double speed) {
  std::vector<PolarPlace> places;
  for (std::size_t k = 1; k < loop.x.size(); ++k) {
    const double from = loop.along[k - 1], to = loop.along[k];
    if (!(std::min(from, to) <= speed && speed <= std::max(from, to)) || from == to) continue;
    const double share = (speed - from) / (to - from);
    const PolarPlace place{loop.x[k - 1] + share * (loop.x[k] - loop.x[k - 1]),
                           loop.y[k - 1] + share * (loop.y[k] - loop.y[k - 1])};
    if (std::isfinite(place.x) && std::isfinite(place.y)) places.push_back(place);
  }
  return places;
}

/// Round speeds along the loop, the coarser ones first, as far as their names have room.
Curve add_speeds(const Curve& loop, const Axis& amplitude, Panel& p) {
  Curve marks{.paint = Paint::ink, .has_line = false};
  marks.has_marker = true;
  marks.size = 5.0;
  if (loop.along.size() < 2) return marks;
  const auto [slowest, fastest] = std::minmax_element(loop.along.begin(), loop.along.end());
  if (*fastest - *slowest < 1e-6 * *fastest) return marks;  // a steady record
  constexpr std::size_t many = 16;
  const double apart = amplitude.last / 5.5, rim = 0.93 * amplitude.last;
  std::vector<PolarPlace> taken;
  for (const Label& l : p.labels) taken.push_back({l.x, l.y});  // names of circles
  // a sharp resonance goes round within a few speeds: finer steps, where the coarse ones leave room
  for (const int most : {5, 10, 20, 50, 100, 200, 500, 1000}) {
    const std::vector<Tick> ticks = Axis{.first = *slowest, .last = *fastest}.ticks(most);
    for (const Tick& tick : ticks) {
      for (const PolarPlace& at : places_at(loop, tick.value)) {
        const bool is_free = std::ranges::none_of(
            taken, [&](const PolarPlace& t) { return std::hypot(t.x - at.x, t.y - at.y) < apart; });
        if (!is_free || marks.x.size() >= many) continue;
        if (std::hypot(at.x, at.y) > rim) continue;  // lags stand on the rim
        taken.push_back(at);
        marks.x.push_back(at.x);
        marks.y.push_back(at.y);
        p.labels.push_back(label_outwards({at.x, at.y}, tick.label));
      }
    }
  }
  return marks;
}

}  // namespace

Figure polar_figure(const std::vector<double>& speed, const PolarCurve& shown) {
  Figure f{.variant = shown.name, .width = 560.0, .height = 600.0};
  const DisplayUnit& unit = shown.unit;
  double largest = 0.0;
  Panel p;
  p.has_equal_scales = true;
  p.has_frame = false;
  p.x.title = with_unit("high spot along x", unit);
  p.y.title = with_unit("high spot along y", unit);
  Curve c{.paint = Paint::forward};
  c.width = 1.8;
  for (Eigen::Index k = 0; k < shown.a.size(); ++k) {
    const double size = 2.0 * unit.factor * std::abs(shown.a(k)), phase = std::arg(shown.a(k));
    add_place(c, polar(size, shown.angle + phase));
    if (std::isfinite(size)) largest = std::max(largest, size);
    c.hover.push_back(fmt::format("{:.5g} {}: {:.4g} {}, lag {:.1f}°",
                                  speed[static_cast<std::size_t>(k)], speed_unit().name, size,
                                  unit.name, -phase / degree));
  }
  c.along = speed;
  c.along_title = "speed";
  const Axis amplitude = axis_around({0.0, largest}, Scale::linear);
  add_polar_grid(shown, amplitude, p);
  add_polar_marks(shown, amplitude.last, p);
  Curve marks = add_speeds(c, amplitude, p);
  constexpr double reach = 1.4;
  p.x.first = p.y.first = -reach * amplitude.last;
  p.x.last = p.y.last = reach * amplitude.last;
  Curve operating{.name = "operating speed", .paint = Paint::alarm, .has_line = false};
  operating.has_marker = true;
  operating.marker = Marker::diamond;
  operating.size = 9.0;
  for (const PolarPlace& at : places_at(c, shown.operating)) {
    operating.x.push_back(at.x);
    operating.y.push_back(at.y);
    operating.hover.push_back(shown_value(shown.operating * speed_unit().size, "rpm", ".0f"));
  }
  p.curves.push_back(std::move(c));
  p.curves.push_back(std::move(marks));
  if (!operating.x.empty()) p.curves.push_back(std::move(operating));
  f.panels.push_back(std::move(p));
  f.notes = {
      "Radius: amplitude peak to peak. Angle: where the high spot is at phase 0, as its lag behind "
      "the probe, against the rotation. " +
      shown_heading("Numbers along the loop are speeds", "rpm") + "."};
  return f;
}

}  // namespace whirl::inline io::figures
