// Trends: overall, 1X and gap of probes along a record or from record to record, with limits.

#include "libdata/measured/trend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdata/measured/zones.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Along what a trend is drawn.
struct TrendAxis {
  std::string variant, title, cursor{};
  std::vector<double> values;
  std::vector<std::size_t> order;  ///< of the points, so that values ascend
};

TrendAxis axis_along(const Trend& trend, bool is_over_speed) {
  TrendAxis axis;
  for (std::size_t k = 0; k < trend.number.size(); ++k) axis.order.push_back(k);
  const auto speed = [&](std::size_t k) { return trend.speed(static_cast<Eigen::Index>(k)); };
  if (is_over_speed) {
    std::stable_sort(axis.order.begin(), axis.order.end(),
                     [&](std::size_t a, std::size_t b) { return speed(a) < speed(b); });
    axis.variant = "over speed";
    axis.title = shown_heading("speed", "rpm");
    for (const std::size_t k : axis.order) axis.values.push_back(speed(k) / speed_unit().size);
    return axis;
  }
  const bool is_of_records = !trend.records.empty();
  axis.variant = is_of_records ? "over records" : "over time";
  axis.title = is_of_records ? "record" : "time [s]";
  axis.cursor = is_of_records ? "" : "time";
  for (const std::size_t k : axis.order) {
    axis.values.push_back(is_of_records ? trend.number[k]
                                        : trend.time(static_cast<Eigen::Index>(k)));
  }
  return axis;
}

template <class Values>
Curve trend_curve(const Trend& trend, const TrendAxis& axis, std::size_t probe,
                  const Values& values) {
  Curve c{.name = probe_name(trend.probes[probe]), .paint = series_paint(probe), .x = axis.values};
  for (const std::size_t k : axis.order) c.y.push_back(values(static_cast<Eigen::Index>(k)));
  c.width = 1.5;
  c.dash = series_dash(probe);
  c.has_marker = !trend.records.empty();
  c.size = 6.0;
  for (const std::size_t k : axis.order) {
    if (k < trend.records.size()) c.hover.push_back(trend.records[k]);
  }
  return c;
}

/// Boundaries of zones at the speeds of the points.
void add_zones(const Trend& trend, const TrendAxis& axis, ZoneClass of, double factor, Panel& p) {
  for (const auto& [name, limit] :
       {std::pair{"A/B", &ZoneLimits::ab}, {"B/C", &ZoneLimits::bc}, {"C/D", &ZoneLimits::cd}}) {
    Curve c{.name = "zones", .end_name = name, .paint = Paint::gray, .x = axis.values};
    c.dash = Dash::dashed;
    c.width = 1.2;
    c.is_key = false;
    for (const std::size_t k : axis.order) {
      const double speed = trend.speed(static_cast<Eigen::Index>(k));
      c.y.push_back(speed > 0.0 ? factor * (zone_limits(of, speed).*limit) : std::nan(""));
    }
    p.curves.push_back(std::move(c));
  }
}

void add_limit(const std::optional<double>& limit, const char* name, Paint paint, double factor,
               Panel& p) {
  if (!limit) return;
  p.rules.push_back({Rule::Kind::horizontal, factor * *limit, name, paint, Dash::solid});
}

Figure trend_along(const Trend& trend, const TrendAxis& axis, const std::vector<std::size_t>& drawn,
                   const ZoneReport* zones) {
  Figure f{.variant = axis.variant, .width = 820.0};
  f.subtitle = "Trend " + axis.variant;
  double largest = 0.0;
  std::vector<ProbeLabel> labels;
  for (const std::size_t i : drawn) {
    labels.push_back(trend.probes[i]);
    largest = std::max(largest, trend.probes[i].overall.maxCoeff());
  }
  const DisplayUnit unit = unit_of(labels, largest);
  const auto of = zones ? value_named<ZoneClass>(zones->of) : std::nullopt;
  Panel overall, first, phase, gap, velocity;
  overall.y.title = with_unit("overall p-p", unit);
  overall.y.first = first.y.first = velocity.y.first = 0.0;
  first.y.title = with_unit("1X p-p", unit);
  phase.y = {.title = "1X phase lag [deg]", .first = -180.0, .last = 180.0, .step = 90.0};
  gap.y.title = with_unit("gap", unit);
  velocity.y.title = shown_heading("velocity r.m.s.", "mm/s");
  const double per_mm_s = 1.0 / shown_unit("mm/s").size;
  for (const std::size_t i : drawn) {
    const TrendCurve& t = trend.probes[i];
    overall.curves.push_back(
        trend_curve(trend, axis, i, [&](Eigen::Index k) { return unit.factor * t.overall(k); }));
    first.curves.push_back(trend_curve(
        trend, axis, i, [&](Eigen::Index k) { return 2.0 * unit.factor * std::abs(t.first(k)); }));
    phase.curves.push_back(trend_curve(
        trend, axis, i, [&](Eigen::Index k) { return -std::arg(t.first(k)) / degree; }));
    phase.curves.back().has_line = false;
    phase.curves.back().has_marker = true;
    phase.curves.back().size = 3.0;
    gap.curves.push_back(
        trend_curve(trend, axis, i, [&](Eigen::Index k) { return unit.factor * t.gap(k); }));
    velocity.curves.push_back(
        trend_curve(trend, axis, i, [&](Eigen::Index k) { return per_mm_s * t.velocity(k); }));
  }
  add_limit(trend.alarm, "alarm", Paint::mixed, unit.factor, overall);
  add_limit(trend.trip, "trip", Paint::alarm, unit.factor, overall);
  const bool is_of_housing = of && *of != ZoneClass::shaft;
  if (of) {
    if (is_of_housing) {
      add_zones(trend, axis, *of, per_mm_s, velocity);
    } else {
      add_zones(trend, axis, *of, unit.factor, overall);
    }
    f.notes.push_back(
        fmt::format("Zones of ISO 20816 for vibration of the {}; the record is in zone {}.",
                    zones->of, zones->zone));
  }
  f.panels.push_back(std::move(overall));
  if (is_of_housing) f.panels.push_back(std::move(velocity));
  for (Panel* p : {&first, &phase, &gap}) f.panels.push_back(std::move(*p));
  f.panels[0].share = 1.4;
  for (Panel& p : f.panels) {
    p.x.title = axis.title;
    p.cursor = axis.cursor;
    if (!trend.records.empty() && axis.variant != "over speed") p.x.step = 1.0;
  }
  f.height = 90.0 + 160.0 * static_cast<double>(f.panels.size());
  if (trend.alarm || trend.trip) f.notes.push_back("Limits are of the overall reading.");
  return f;
}

std::vector<Figure> trend_figures(const ResultView& result) {
  const auto& trend = result_of<Trend>(result);
  const auto points = std::ssize(trend.number);
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < trend.probes.size(); ++i) {
    const TrendCurve& t = trend.probes[i];
    if (t.gap.size() != points || t.overall.size() != points || t.first.size() != points ||
        t.velocity.size() != points || trend.speed.size() != points) {
      throw FileError("the trend is not of its points");
    }
    if (is_drawn(result, t)) drawn.push_back(i);
  }
  if (drawn.empty() || points == 0) return {};
  const bool has_zones = result.file.has(dataset_of<ZoneReport>(&ZoneVerdict::zone));
  const ZoneReport* zones = has_zones ? &result_of<ZoneReport>(result) : nullptr;
  std::vector<Figure> figures{trend_along(trend, axis_along(trend, false), drawn, zones)};
  const double slowest = trend.speed.minCoeff(), fastest = trend.speed.maxCoeff();
  if (fastest - slowest > 0.1 * fastest) {
    figures.push_back(trend_along(trend, axis_along(trend, true), drawn, zones));
  }
  return figures;
}

}  // namespace

FigureKind trend_kind() {
  return {
      .name = "trend",
      .title = "Trend",
      .summary =
          "overall, 1X and gap of probes along a record or from record to record, with limits",
      .needs = {dataset_of<Trend>(&TrendCurve::overall)},
      .make = trend_figures,
  };
}

}  // namespace whirl::inline io
