// What is measured: orbits and full spectra at the stations of probes, and orders along a run-up.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/interpolation.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libio/figures/bode_curves.hpp"
#include "libio/figures/full_spectrum.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

std::vector<Figure> measured_spectrum_figures(const ResultView& result) {
  const auto& measured = result_of<MeasuredIdentification>(result);
  std::vector<Figure> figures;
  for (const StationFullSpectrum& s : measured.stations) {
    if (s.amplitude.size() != measured.frequency.size()) {
      throw FileError("the measured spectra are not of their frequencies");
    }
    if (!(s.amplitude.maxCoeff() > 0.0)) continue;
    figures.push_back(full_spectrum(result, s.station, measured.frequency, s.amplitude,
                                    unit_of(measured.probes, s.amplitude.maxCoeff())));
  }
  return figures;
}

/// Curves of one order, whose readings are told in one unit.
struct DrawnOrder {
  std::string name;  ///< "1X"
  BodeCurves curves;
};

std::vector<DrawnOrder> drawn_orders(const ResultView& result, const OrderTracking& tracking) {
  std::vector<double> orders;
  for (const OrderCurve& c : tracking.curves) {
    if (std::find(orders.begin(), orders.end(), c.order) == orders.end()) orders.push_back(c.order);
  }
  std::vector<DrawnOrder> drawn;
  for (const double order : orders) {
    std::vector<BodeCurves> by_unit;
    for (const OrderCurve& c : tracking.curves) {
      if (c.order != order || !is_drawn(result, c)) continue;
      if (c.response.size() != tracking.speed.size()) {
        throw FileError("the measured orders are not of their speeds");
      }
      add_reading(c, c.response, by_unit);
    }
    for (BodeCurves& curves : by_unit) {
      drawn.push_back({fmt::format("{:g}X", order), std::move(curves)});
    }
  }
  return drawn;
}

/// What was taken off.
std::vector<std::string> slow_roll_notes(const OrderTracking& tracking) {
  if (!tracking.slow_roll) return {};
  return {
      fmt::format("Readings at {:.4g} rpm (slow roll) are taken off.", *tracking.slow_roll / rpm)};
}

std::vector<Figure> order_bode_figures(const ResultView& result) {
  const auto& tracking = result_of<OrderTracking>(result);
  const std::vector<double> speed = scaled(numbers(tracking.speed), 1.0 / rpm);
  std::vector<Figure> figures;
  for (const DrawnOrder& order : drawn_orders(result, tracking)) {
    Figure f = bode_figure(result, speed, order.curves);
    f.variant = fmt::format("{}, probes in {}", order.name, order.curves.unit.name);
    f.probes = order.curves.probes;
    f.subtitle = fmt::format("{} along the record, amplitude peak to peak", order.name);
    f.notes = slow_roll_notes(tracking);
    const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
    for (Panel& p : f.panels) {
      p.x.first = *slowest, p.x.last = *fastest;
      const bool is_steady = *fastest - *slowest < 0.01 * *fastest;
      if (is_steady) p.x.first = 0.0, p.x.last = 1.1 * *fastest;
      p.rules.clear();  // the mean speed of the record says nothing here
    }
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> order_polar_figures(const ResultView& result) {
  const auto& tracking = result_of<OrderTracking>(result);
  const std::vector<double> speed = scaled(numbers(tracking.speed), 1.0 / rpm);
  std::vector<Figure> figures;
  for (const DrawnOrder& order : drawn_orders(result, tracking)) {
    for (std::size_t i = 0; i < order.curves.names.size(); ++i) {
      const std::string name = fmt::format("{}, {}", order.name, order.curves.names[i]);
      const CVec a = order.curves.a.row(static_cast<Eigen::Index>(i)).transpose();
      Figure f = polar_figure(speed, name, a, order.curves.unit);
      f.probes = {order.curves.probes[i]};
      f.subtitle = name + ": complex amplitude, peak to peak, speeds along the loop";
      for (const std::string& note : slow_roll_notes(tracking)) f.notes.push_back(note);
      figures.push_back(std::move(f));
    }
  }
  return figures;
}

/// A record's last revolutions.
struct LastRevolutions {
  double from = 0.0;  ///< when they begin [s]
  double rpm = 0.0;   ///< speed there; 0: the rotor does not spin

  LastRevolutions(const StationRecord& record, double speed) : rpm(speed / whirl::rpm) {
    constexpr std::size_t count = 4;
    const std::vector<double>& turns = record.turns;
    const double end = record.time(record.time.size() - 1);
    from = speed > 0.0 ? end - static_cast<double>(count) * turn / speed : record.time(0);
    if (turns.size() <= count) return;
    from = turns[turns.size() - 1 - count];
    rpm = 60.0 * static_cast<double>(count) / (turns.back() - from);
  }
};

std::vector<Figure> measured_orbit_figures(const ResultView& result) {
  const auto& record = result_of<StationRecord>(result);
  const std::vector<ProbeLabel>& probes = result_of<MeasuredIdentification>(result).probes;
  const Eigen::Index n = record.time.size();
  if (n < 2) return {};
  const double* times = record.time.data();
  const LastRevolutions last(record, speed_of(result));
  const Eigen::Index from = std::lower_bound(times, times + n - 1, last.from) - times;
  std::vector<Figure> figures;
  for (const StationMotion& s : record.stations) {
    if (s.x.size() != n || s.y.size() != n) {
      throw FileError("the measured motion is not of its times");
    }
    const Vec x = s.x.tail(n - from), y = s.y.tail(n - from);
    const DisplayUnit unit =
        unit_of(probes, std::hypot(x.cwiseAbs().maxCoeff(), y.cwiseAbs().maxCoeff()));
    Figure f{.variant = s.station, .width = 560.0, .height = 560.0};
    f.subtitle = fmt::format("{}: measured orbit at {:.4g} rpm", s.station, last.rpm);
    Panel p;
    p.has_equal_scales = true;
    p.x.title = with_unit("x", unit);
    p.y.title = with_unit("y", unit);
    Curve c{.name = "path", .paint = Paint::forward, .x = scaled(numbers(x), unit.factor)};
    c.y = scaled(numbers(y), unit.factor);
    c.along = numbers(Vec(record.time.tail(n - from)));
    c.along_title = "time";
    c.width = 1.2;
    Curve dots{.name = "key-phasor", .paint = Paint::alarm, .has_line = false};
    dots.has_marker = true;
    const auto at = [&](const Vec& signal, double t) {
      const auto size = static_cast<std::size_t>(n);
      return interpolated(std::span(record.time.data(), size), std::span(signal.data(), size), t,
                          Interpolation::linear);
    };
    for (const double t : record.turns) {
      if (t < record.time(from) || t > record.time(n - 1)) continue;
      dots.x.push_back(unit.factor * at(s.x, t));
      dots.y.push_back(unit.factor * at(s.y, t));
    }
    p.curves = {std::move(c)};
    if (!dots.x.empty()) p.curves.push_back(std::move(dots));
    f.panels = {std::move(p)};
    f.notes = {
        fmt::format("The last {:.3g} s of the record.", record.time(n - 1) - record.time(from))};
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind measured_orbit_kind() {
  return {
      .name = "measured_orbit",
      .title = "Measured orbit",
      .summary = "path of a station of probes, with a dot where the key-phasor is",
      .needs = {dataset_of<StationRecord>(&StationMotion::x)},
      .make = measured_orbit_figures,
  };
}

FigureKind measured_spectrum_kind() {
  return {
      .name = "measured_spectrum",
      .title = "Measured spectrum",
      .summary = "full spectrum of a record, backward left and forward right",
      .needs = {dataset_of<MeasuredIdentification>(&StationFullSpectrum::amplitude)},
      .make = measured_spectrum_figures,
  };
}

FigureKind order_bode_kind() {
  return {
      .name = "order_bode",
      .title = "Bode of a record",
      .summary = "amplitude and phase of orders along a run-up",
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
