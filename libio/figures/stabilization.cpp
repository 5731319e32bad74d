// Modes of a running machine: the stabilization diagram, and damping over frequency.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdata/measured/running_modes.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// How far a pole is from being a mode, for the eye.
struct PoleKind {
  const char* name;
  Paint paint;
  Marker marker;
  double size;
  bool (*is)(const OrderPole&);
};

bool is_harmonic(const OrderPole& p) {
  return p.harmonic > 0;
}

/// Each pole is of the first kind that it fits; drawn last.
constexpr PoleKind pole_kinds[] = {
    {"harmonic of the speed", Paint::alarm, Marker::cross, 7.0, is_harmonic},
    {"stable pole of a mode", Paint::forward, Marker::circle, 6.0,
     [](const OrderPole& p) { return p.mode >= 0; }},
    {"stable, of no mode", series_paint(2), Marker::square, 5.0,
     [](const OrderPole& p) { return p.is_stable(); }},
    {"frequency and shape stable", series_paint(4), Marker::diamond, 5.0,
     [](const OrderPole& p) { return p.is_stable_frequency && p.is_stable_shape; }},
    {"frequency stable", Paint::gray, Marker::triangle, 4.0,
     [](const OrderPole& p) { return p.is_stable_frequency; }},
    {"new", Paint::gray, Marker::circle, 2.5, [](const OrderPole&) { return true; }},
};

/// Where the first singular value has the most of its range: to the highest pole of a mode, and
/// some.
double last_frequency(const RunningModes& found) {
  double highest = 0.0;
  for (const RunningMode& mode : found.modes) highest = std::max(highest, mode.frequency());
  const double end = found.lines.empty() ? highest : found.lines.back();
  return highest > 0.0 ? std::min(end, 1.35 * highest) : end;
}

std::vector<double> singular_value(const RunningModes& found, Eigen::Index i) {
  const Eigen::RowVectorXd values = found.singular_values.row(i);
  std::vector<double> list(values.begin(), values.end());
  for (double& v : list) {
    if (!(v > 0.0)) v = not_set;
  }
  return list;
}

FigureAxis frequency_axis(const RunningModes& found, const DisplayUnit& unit) {
  return {.title = with_unit("frequency", unit),
          .first = 0.0,
          .last = last_frequency(found) * unit.factor};
}

void add_harmonics(Panel& p, const RunningModes& found, const DisplayUnit& unit, bool are_named) {
  const double end = last_frequency(found);
  for (int k = 1; k <= found.harmonics && k * found.speed < end; ++k) {
    p.rules.push_back({Rule::Kind::vertical, k * found.speed * unit.factor,
                       are_named ? fmt::format("{}X", k) : "", Paint::alarm, Dash::dotted});
  }
}

Panel spectrum_panel(const RunningModes& found, const DisplayUnit& unit) {
  constexpr Eigen::Index most = 4;  // singular values
  Panel p;
  p.share = 0.8;
  p.cursor = "frequency";
  p.x = frequency_axis(found, unit);
  p.y = {.title = "singular values [1/Hz]", .scale = Scale::logarithmic};
  const std::vector<double> lines = scaled(found.lines, unit.factor);
  for (Eigen::Index i = std::min(most, found.singular_values.rows()); i-- > 0;) {
    Curve c{.name = i == 0   ? "largest singular value"
                    : i == 1 ? "the next ones"
                             : "",
            .paint = i == 0 ? Paint::ink : Paint::gray,
            .x = lines,
            .y = singular_value(found, i)};
    c.width = i == 0 ? 1.5 : 0.8;
    c.is_key = i < 2;
    p.curves.push_back(std::move(c));
  }
  Curve peaks{.name = "peak (decomposition)", .paint = Paint::forward, .has_line = false};
  peaks.has_marker = true;
  peaks.marker = Marker::triangle_down;
  peaks.size = 8.0;
  for (const DecomposedMode& peak : found.peaks) {
    peaks.x.push_back(peak.line * unit.factor);
    peaks.y.push_back(peak.height);
    peaks.hover.push_back(fmt::format("{:.5g} {}, damping ratio {:.2f} %",
                                      peak.frequency() * unit.factor, unit.name,
                                      100.0 * peak.damping_ratio()));
  }
  if (!peaks.x.empty()) p.curves.push_back(std::move(peaks));
  add_harmonics(p, found, unit, true);
  return p;
}

/// The largest singular value behind the poles, its logarithm on the axis of orders.
Curve backdrop(const RunningModes& found, const DisplayUnit& unit, double bottom, double top) {
  Curve c{.paint = Paint::faint, .x = scaled(found.lines, unit.factor)};
  const std::vector<double> values = singular_value(found, 0);
  const double end = last_frequency(found);
  double low = HUGE_VAL, high = 0.0;
  for (std::size_t i = 1; i < values.size() && found.lines[i] <= end; ++i) {
    low = std::fmin(low, values[i]);
    high = std::fmax(high, values[i]);
  }
  for (const double v : values) {
    const double share = std::log(v / low) / std::log(high / low);
    c.y.push_back(share >= 0.0 ? bottom + share * (top - bottom) : not_set);
  }
  c.width = 1.4;
  return c;
}

std::string hover_of(const OrderPole& pole, const DisplayUnit& unit) {
  std::string text =
      fmt::format("order {}: {:.5g} {}, damping ratio {:.2f} %", pole.order,
                  pole.frequency() * unit.factor, unit.name, 100.0 * pole.damping_ratio());
  if (pole.harmonic > 0) text += fmt::format(", {}X", pole.harmonic);
  if (pole.mode >= 0) text += fmt::format(", mode {}", pole.mode + 1);
  return text;
}

/// Markers of the poles of each kind, at places that a function gives.
template <class Place>
void add_poles(Panel& p, const RunningModes& found, const DisplayUnit& unit, const Place& place) {
  std::vector<Curve> curves;
  for (const PoleKind& kind : pole_kinds) {
    Curve c{.name = kind.name, .paint = kind.paint, .has_line = false};
    c.has_marker = true;
    c.marker = kind.marker;
    c.size = kind.size;
    curves.push_back(std::move(c));
  }
  for (const OrderPole& pole : found.poles) {
    const auto kind = std::find_if(std::begin(pole_kinds), std::end(pole_kinds),
                                   [&](const PoleKind& k) { return k.is(pole); });
    Curve& c = curves[static_cast<std::size_t>(kind - std::begin(pole_kinds))];
    c.x.push_back(pole.frequency() * unit.factor);
    c.y.push_back(place(pole));
    c.hover.push_back(hover_of(pole, unit));
  }
  for (auto c = curves.rbegin(); c != curves.rend(); ++c) {
    if (!c->x.empty()) p.curves.push_back(std::move(*c));
  }
}

Panel order_panel(const RunningModes& found, const DisplayUnit& unit) {
  Panel p;
  p.share = 1.6;
  p.cursor = "frequency";
  p.x = frequency_axis(found, unit);
  p.y = {.title = "model order", .first = 0.0, .last = found.most_order + 2.0};
  p.curves.push_back(backdrop(found, unit, 0.0, found.most_order + 1.0));
  add_poles(p, found, unit, [](const OrderPole& pole) { return static_cast<double>(pole.order); });
  int number = 0;
  for (const RunningMode& mode : found.modes) {
    p.rules.push_back({Rule::Kind::vertical, mode.frequency() * unit.factor,
                       fmt::format("{}", ++number), Paint::forward, Dash::solid});
  }
  add_harmonics(p, found, unit, false);
  return p;
}

FigureTable mode_table(const RunningModes& found, const DisplayUnit& unit) {
  FigureTable t{.header = {"mode", with_unit("frequency", unit), "±", "damping ratio [%]", "±",
                           "log decrement", "orders"}};
  int number = 0;
  const auto deviation = [](double v, const char* format) {
    return std::isfinite(v) ? fmt::format(fmt::runtime(format), v) : std::string("-");
  };
  for (const RunningMode& mode : found.modes) {
    t.rows.push_back({fmt::format("{}", ++number),
                      fmt::format("{:.5g}", mode.frequency() * unit.factor),
                      deviation(mode.frequency_deviation * unit.factor, "{:.2g}"),
                      fmt::format("{:.2f}", 100.0 * mode.damping_ratio()),
                      deviation(100.0 * mode.damping_deviation, "{:.2f}"),
                      fmt::format("{:.3f}", mode.log_decrement()),
                      fmt::format("{} of {}", mode.orders, found.most_order / 2)});
  }
  return t;
}

std::vector<std::string> notes_on(const RunningModes& found) {
  if (found.harmonics == 0) return {};
  return {fmt::format("{} harmonics of {} were {}.", found.harmonics,
                      shown_value(found.speed, "rpm", ".5g"),
                      found.are_harmonics_removed ? "taken out of the record before" : "marked")};
}

/// Damping over frequency: poles of one mode are a heap, others are scattered.
Figure damping_figure(const RunningModes& found, const DisplayUnit& unit) {
  Figure f{.variant = "damping", .height = 420.0};
  f.subtitle = "Poles of all model orders: damping over frequency";
  Panel p;
  p.x = frequency_axis(found, unit);
  p.y = {.title = "damping ratio [%]", .first = 0.0};
  double most = 0.0;
  for (const RunningMode& mode : found.modes) most = std::max(most, mode.damping_ratio());
  p.y.last = axis_around({0.0, 200.0 * std::max(most, 0.01)}, Scale::linear).last;
  add_poles(p, found, unit, [](const OrderPole& pole) { return 100.0 * pole.damping_ratio(); });
  int number = 0;
  for (const RunningMode& mode : found.modes) {
    const double x = mode.frequency() * unit.factor, y = 100.0 * mode.damping_ratio();
    Label label{x, y, fmt::format("{}", ++number)};
    p.labels.push_back(std::move(label));
    const double dx = 2.0 * mode.frequency_deviation * unit.factor,
                 dy = 200.0 * mode.damping_deviation;
    if (!std::isfinite(dx) || !std::isfinite(dy)) continue;
    Curve bars{.name = "mode ± two standard deviations", .paint = Paint::ink};
    bars.x = {x - dx, x + dx, not_set, x, x};
    bars.y = {y, y, not_set, y - dy, y + dy};
    p.curves.push_back(std::move(bars));
  }
  add_harmonics(p, found, unit, true);
  f.panels.push_back(std::move(p));
  f.notes = notes_on(found);
  return f;
}

std::vector<Figure> stabilization_figures(const ResultView& result) {
  const auto& found = result_of<RunningModes>(result);
  const DisplayUnit unit = result.frequency;
  Figure f{.width = 860.0, .height = 700.0};
  f.subtitle = fmt::format("Stabilization diagram of {} channels, {:.4g} s at {:.5g} Hz",
                           found.channels.size(), found.duration, found.rate);
  f.panels = {spectrum_panel(found, unit), order_panel(found, unit)};
  f.table = mode_table(found, unit);
  f.notes = notes_on(found);
  return {f, damping_figure(found, unit)};
}

}  // namespace

FigureKind stabilization_kind() {
  return {
      .name = "stabilization",
      .title = "Running modes",
      .summary = "poles of a measured motion over model order, with the modes that they agree on",
      .needs = {dataset_of<RunningModes>(&OrderPole::order),
                dataset_of<RunningModes>(&RunningModes::singular_values)},
      .make = stabilization_figures,
  };
}

}  // namespace whirl::inline io
