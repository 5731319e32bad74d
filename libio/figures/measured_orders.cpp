// Orders along the record of a run-up: Bode and polar plots, with peaks and amplification factors,
// and the model's curve beside them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libio/figures/bode_curves.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr std::size_t most_together = 4;  ///< probes in one Bode plot that the eye keeps apart

/// Curves of one order, whose readings are told in one unit.
struct DrawnOrder {
  std::string name;  ///< "1X"
  BodeCurves curves;
  std::vector<std::size_t> numbers;  ///< of the curves in the result
};

std::vector<DrawnOrder> drawn_orders(const ResultView& result, const OrderTracking& tracking) {
  std::vector<double> orders;
  for (const OrderCurve& c : tracking.curves) {
    if (std::find(orders.begin(), orders.end(), c.order) == orders.end()) orders.push_back(c.order);
  }
  std::vector<DrawnOrder> drawn;
  for (const double order : orders) {
    std::vector<BodeCurves> by_unit;
    std::vector<std::vector<std::size_t>> numbers;
    for (std::size_t i = 0; i < tracking.curves.size(); ++i) {
      const OrderCurve& c = tracking.curves[i];
      if (c.order != order || !is_drawn(result, c)) continue;
      const bool has_model = c.model.size() > 0;
      if (c.response.size() != tracking.speed.size() ||
          (has_model && c.model.size() != tracking.speed.size())) {
        throw FileError("the measured orders are not of their speeds");
      }
      add_reading(c, c.response, by_unit);
      numbers.resize(by_unit.size());
      for (std::size_t u = 0; u < by_unit.size(); ++u) {
        if (by_unit[u].unit.name == c.unit) numbers[u].push_back(i);
      }
    }
    for (std::size_t u = 0; u < by_unit.size(); ++u) {
      drawn.push_back({fmt::format("{:g}X", order), std::move(by_unit[u]), numbers[u]});
    }
  }
  return drawn;
}

/// The same in parts of so many probes that a plot is clear.
std::vector<DrawnOrder> in_parts(const DrawnOrder& all) {
  std::vector<DrawnOrder> parts;
  for (std::size_t from = 0; from < all.numbers.size(); from += 2) {
    const std::size_t count = std::min<std::size_t>(2, all.numbers.size() - from);
    DrawnOrder part{all.name, {}, {}};
    part.curves.unit = all.curves.unit;
    part.curves.a =
        all.curves.a.middleRows(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(count));
    for (std::size_t k = from; k < from + count; ++k) {
      part.curves.names.push_back(all.curves.names[k]);
      part.curves.probes.push_back(all.curves.probes[k]);
      part.curves.angles.push_back(all.curves.angles[k]);
      part.numbers.push_back(all.numbers[k]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// What was taken off, and what the model's curve is.
std::vector<std::string> order_notes(const OrderTracking& tracking, bool has_model) {
  std::vector<std::string> notes;
  if (tracking.slow_roll) {
    notes.push_back(fmt::format("Readings at {} (slow roll) are taken off.",
                                shown_value(*tracking.slow_roll, "rpm", ".4g")));
  }
  if (has_model && tracking.model_factor) {
    const bool is_own = *tracking.model_factor == 1.0 && tracking.model_turn.value_or(0.0) == 0.0;
    notes.push_back(
        is_own
            ? "Dotted: the model's response to its unbalances."
            : with_minus(fmt::format(
                  "Dotted: the model's response to its unbalances times {:.4g}, turned by {:+.1f}"
                  "°, which fits all 1X readings best (least squares).",
                  *tracking.model_factor, tracking.model_turn.value_or(0.0) / degree)));
  }
  return notes;
}

/// Peaks of the curves of a plot.
std::vector<const OrderPeak*> peaks_of(const OrderTracking& tracking, const DrawnOrder& order) {
  std::vector<const OrderPeak*> peaks;
  for (const OrderPeak& peak : tracking.peaks) {
    const auto number = static_cast<std::size_t>(peak.row);
    if (std::find(order.numbers.begin(), order.numbers.end(), number) != order.numbers.end()) {
      peaks.push_back(&peak);
    }
  }
  return peaks;
}

std::string factor_text(const OrderPeak& peak) {
  return std::isfinite(peak.amplification()) ? fmt::format("AF {:.3g}", peak.amplification()) : "";
}

FigureTable table_of_order_peaks(const OrderTracking& tracking, const DrawnOrder& order,
                                 const std::vector<const OrderPeak*>& peaks) {
  const auto speed = [](double value) {
    return std::isfinite(value) ? shown_number(value, "rpm", ".1f") : "-";
  };
  FigureTable table;
  table.header = {
      "probe",     shown_heading("peak", "rpm"), fmt::format("p-p [{}]", order.curves.unit.name),
      "lag [deg]", shown_heading("N1", "rpm"),   shown_heading("N2", "rpm"),
      "AF"};
  for (const OrderPeak* peak : peaks) {
    const OrderCurve& c = tracking.curves[static_cast<std::size_t>(peak->row)];
    const double factor = peak->amplification();
    table.rows.push_back({c.name, speed(peak->speed),
                          fmt::format("{:.4g}", order.curves.unit.factor * peak->peak_to_peak()),
                          with_minus(fmt::format("{:+.1f}", -peak->phase_deg())),
                          speed(peak->below), speed(peak->above),
                          std::isfinite(factor) ? fmt::format("{:.3g}", factor) : "-"});
  }
  return table;
}

/// Tops and half-power points of the peaks, in the amplitude panel.
void mark_peaks(const OrderTracking& tracking, const DrawnOrder& order,
                const std::vector<const OrderPeak*>& peaks, Panel& p) {
  Curve tops{.name = "peak", .paint = Paint::alarm, .has_line = false};
  Curve sides{.name = "half power", .paint = Paint::alarm, .has_line = false};
  tops.has_marker = sides.has_marker = true;
  tops.size = 7.0;
  sides.size = 5.0;
  sides.marker = Marker::diamond;
  for (const OrderPeak* peak : peaks) {
    const double size = order.curves.unit.factor * peak->peak_to_peak();
    const std::string& name = tracking.curves[static_cast<std::size_t>(peak->row)].name;
    tops.x.push_back(peak->speed / speed_unit().size);
    tops.y.push_back(size);
    tops.hover.push_back(name);
    const bool is_right =
        peak->speed >
        tracking.speed.minCoeff() + 0.6 * (tracking.speed.maxCoeff() - tracking.speed.minCoeff());
    p.labels.push_back({peak->speed / speed_unit().size, size,
                        fmt::format("{}{}{}", shown_value(peak->speed, "rpm", ".0f"),
                                    factor_text(*peak).empty() ? "" : ", ", factor_text(*peak)),
                        is_right ? Anchor::end : Anchor::start, is_right ? -7.0 : 7.0});
    if (!std::isfinite(peak->amplification())) continue;
    for (const double side : peak->half_power()) {
      sides.x.push_back(side / speed_unit().size);
      sides.y.push_back(size / std::sqrt(2.0));
      sides.hover.push_back(name);
    }
  }
  if (!tops.x.empty()) p.curves.push_back(std::move(tops));
  if (!sides.x.empty()) p.curves.push_back(std::move(sides));
}

/// Whether the model's reading of an order is known: a file has NaN for orders that it has not.
bool has_model(const OrderCurve& curve) {
  return curve.model.size() > 0 && std::isfinite(curve.model(0).real());
}

/// The model's curves, in the colors of the probes.
/// @return whether there are any
bool add_model(const ResultView& result, const OrderTracking& tracking, const DrawnOrder& order,
               const std::vector<double>& speed, Figure& f) {
  BodeCurves model{order.curves.names, order.curves.a, order.curves.unit, order.curves.probes,
                   order.curves.angles};
  for (std::size_t i = 0; i < order.numbers.size(); ++i) {
    const CVec& curve = tracking.curves[order.numbers[i]].model;
    if (!has_model(tracking.curves[order.numbers[i]])) return false;
    model.a.row(static_cast<Eigen::Index>(i)) = curve.transpose();
  }
  const Figure drawn = bode_figure(result, speed, model);
  for (std::size_t i = 0; i < f.panels.size(); ++i) {
    for (Curve c : drawn.panels[i].curves) {
      c.name = i == 0 ? "model" : "";
      c.dash = Dash::dotted;
      c.width = 1.4;
      f.panels[i].curves.push_back(std::move(c));
    }
  }
  return true;
}

Figure order_bode(const ResultView& result, const OrderTracking& tracking,
                  const std::vector<double>& speed, const DrawnOrder& order) {
  Figure f = bode_figure(result, speed, order.curves);
  f.probes = order.curves.probes;
  f.subtitle = fmt::format("{} along the record, amplitude peak to peak", order.name);
  const std::vector<const OrderPeak*> peaks = peaks_of(tracking, order);
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  for (Panel& p : f.panels) {
    p.x.first = *slowest, p.x.last = *fastest;
    const bool is_steady = *fastest - *slowest < 0.01 * *fastest;
    if (is_steady) p.x.first = 0.0, p.x.last = 1.1 * *fastest;
    p.rules.clear();  // the mean speed of the record says nothing here
  }
  f.notes = order_notes(tracking, add_model(result, tracking, order, speed, f));
  mark_peaks(tracking, order, peaks, f.panels.front());
  if (!peaks.empty()) {
    f.table = table_of_order_peaks(tracking, order, peaks);
    f.notes.push_back("AF = N / (N2 - N1), N1 and N2 the speeds at 0.707 of the peak.");
  }
  return f;
}

std::vector<Figure> order_bode_figures(const ResultView& result) {
  const auto& tracking = result_of<OrderTracking>(result);
  const std::vector<double> speed = scaled(numbers(tracking.speed), 1.0 / speed_unit().size);
  std::vector<Figure> figures;
  for (const DrawnOrder& order : drawn_orders(result, tracking)) {
    Figure together = order_bode(result, tracking, speed, order);
    together.variant = fmt::format("{}, probes in {}", order.name, order.curves.unit.name);
    const bool is_clear = order.numbers.size() <= most_together;
    if (is_clear) figures.push_back(together);
    for (const DrawnOrder& part : is_clear ? std::vector<DrawnOrder>{} : in_parts(order)) {
      Figure f = order_bode(result, tracking, speed, part);
      f.variant = part.name;
      for (const std::string& probe : part.curves.probes) f.variant += ", " + probe;
      figures.push_back(std::move(f));
    }
    if (!is_clear) figures.push_back(std::move(together));
  }
  return figures;
}

std::vector<Figure> order_polar_figures(const ResultView& result) {
  const auto& tracking = result_of<OrderTracking>(result);
  const std::vector<double> speed = scaled(numbers(tracking.speed), 1.0 / speed_unit().size);
  std::vector<Figure> figures;
  for (const DrawnOrder& order : drawn_orders(result, tracking)) {
    for (std::size_t i = 0; i < order.curves.names.size(); ++i) {
      const std::string name = fmt::format("{}, {}", order.name, order.curves.names[i]);
      const CVec a = order.curves.a.row(static_cast<Eigen::Index>(i)).transpose();
      const double angle = order.curves.angles[i];
      Figure f = polar_figure(speed, {name, a, order.curves.unit, order.curves.probes[i], angle,
                                      speed_of(result) / speed_unit().size});
      f.width = 660.0;  // of the table
      f.probes = {order.curves.probes[i]};
      f.subtitle = name + ": complex amplitude, peak to peak, speeds along the loop";
      const DrawnOrder one{order.name, {}, {order.numbers[i]}};
      Curve tops{.name = "peak", .paint = Paint::alarm, .has_line = false};
      tops.has_marker = true;
      tops.size = 8.0;
      for (const OrderPeak* peak : peaks_of(tracking, one)) {
        const Complex top =
            order.curves.unit.factor * peak->peak_to_peak() * std::polar(1.0, angle + peak->phase);
        tops.x.push_back(top.real());
        tops.y.push_back(top.imag());
        tops.hover.push_back(
            fmt::format("{} {}", shown_value(peak->speed, "rpm", ".0f"), factor_text(*peak)));
      }
      const CVec model = tracking.curves[order.numbers[i]].model * std::polar(1.0, angle);
      if (has_model(tracking.curves[order.numbers[i]])) {
        Curve c{.name = "model", .paint = Paint::gray, .dash = Dash::dotted};
        c.x = scaled(numbers(Vec(model.real())), 2.0 * order.curves.unit.factor);
        c.y = scaled(numbers(Vec(model.imag())), 2.0 * order.curves.unit.factor);
        f.panels.front().curves.push_back(std::move(c));
      }
      if (!tops.x.empty()) {
        f.table =
            table_of_order_peaks(tracking, {order.name, order.curves, {}}, peaks_of(tracking, one));
        f.panels.front().curves.push_back(std::move(tops));
      }
      for (const std::string& note :
           order_notes(tracking, has_model(tracking.curves[order.numbers[i]]))) {
        f.notes.push_back(note);
      }
      figures.push_back(std::move(f));
    }
  }
  return figures;
}

}  // namespace

FigureKind order_bode_kind() {
  return {
      .name = "order_bode",
      .title = "Bode of a record",
      .summary = "amplitude and phase of orders along a run-up, with amplification factors",
      .needs = {dataset_of<OrderTracking>(&OrderCurve::response)},
      .make = order_bode_figures,
  };
}

FigureKind order_polar_kind() {
  return {
      .name = "order_polar",
      .title = "Polar of a record",
      .summary = "orders along a run-up in their plane, speeds along the loop",
      .needs = {dataset_of<OrderTracking>(&OrderCurve::response)},
      .make = order_polar_figures,
  };
}

}  // namespace whirl::inline io
