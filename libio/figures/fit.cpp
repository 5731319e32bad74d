// What was measured beside the motions that were found for it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdata/fit/measured_fit.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double shown_revolutions = 4.0;  ///< the last ones

/// Samples of a record that are there, and from when on they are shown.
struct FittedSamples {
  const FittedRecord& record;
  Eigen::Index count = 0, from = 0;

  FittedSamples(const MeasuredFit& fit, int number)
      : record(fit.files.at(static_cast<std::size_t>(number))) {
    while (count < record.time.size() && std::isfinite(record.time(count))) ++count;
    if (count == 0) throw FileError("a record of the fit has no times");
    const double period = record.speed > 0.0 ? turn / record.speed : HUGE_VAL;
    const double first = record.time(count - 1) - shown_revolutions * period;
    while (record.time(from) < first) ++from;
  }

  std::vector<double> of(const Vec& values, double factor, Eigen::Index begin = 0) const {
    if (values.size() < count) throw FileError("the motions of the fit are not of its times");
    return scaled(numbers(Vec(values.segment(begin, count - begin))), factor);
  }
  std::string subtitle(const MeasuredFit& fit) const {
    const std::string name = fit.files.size() > 1 ? record.file + ": " : "";
    return fmt::format("{}{:.4g} revolutions at {}, {:.4g} % of the variance explained", name,
                       record.revolutions, shown_value(record.speed, "rpm", ".4g"),
                       100.0 * fit.explained);
  }
};

Curve dots(std::vector<double> x, std::vector<double> y) {
  Curve c{.name = "measured", .paint = Paint::gray, .x = std::move(x), .y = std::move(y)};
  c.has_line = false;
  c.has_marker = true;
  c.size = 3.0;
  return c;
}

Curve path(std::vector<double> x, std::vector<double> y) {
  Curve c{.name = "found", .paint = Paint::forward, .x = std::move(x), .y = std::move(y)};
  c.width = 1.3;
  return c;
}

FigureTable parameter_table(const MeasuredFit& fit) {
  FigureTable t{.header = {"parameter", "value", "standard deviation"}};
  for (const FittedParameter& p : fit.parameters) {
    const bool is_told = std::isfinite(p.standard_deviation);
    t.rows.push_back({p.path, format_engineering(p.value, p.unit),
                      is_told ? format_engineering(p.standard_deviation, p.unit) : "-"});
  }
  return t;
}

std::vector<std::string> fit_notes(const MeasuredFit& fit) {
  if (fit.has_converged) return {};
  return {"The search did not converge: " + fit.why_not};
}

/// The orbit of a station.
Figure fitted_orbit(const MeasuredFit& fit, const FittedStation& s) {
  const FittedSamples samples(fit, s.record);
  const double size = std::max(s.x.head(samples.count).cwiseAbs().maxCoeff(),
                               s.y.head(samples.count).cwiseAbs().maxCoeff());
  const DisplayUnit unit = unit_of(fit.probes, size);
  Figure f{.variant = fit.files.size() > 1 ? samples.record.file + ", " + s.station : s.station,
           .width = 560.0,
           .height = 560.0};
  f.subtitle = fmt::format("{}: {}", s.station, samples.subtitle(fit));
  Panel p;
  p.has_equal_scales = true;
  p.x.title = with_unit("x", unit);
  p.y.title = with_unit("y", unit);
  const auto of = [&](const Vec& v) { return samples.of(v, unit.factor, samples.from); };
  p.curves = {path(of(s.x), of(s.y)), dots(of(s.measured_x), of(s.measured_y))};
  f.panels = {std::move(p)};
  f.table = parameter_table(fit);
  f.notes = fit_notes(fit);
  return f;
}

Panel time_panel(const FittedSamples& samples, const std::vector<double>& time) {
  Panel p;
  p.cursor = "time";
  p.x.title = "time [s]";
  p.x.first = time[static_cast<std::size_t>(samples.from)];
  p.x.last = time.back();
  return p;
}

/// What the probes of a record read in time, and below what is left of all of them.
Figure fitted_readings(const ResultView& result, const MeasuredFit& fit, int number) {
  const FittedSamples samples(fit, number);
  Figure f{.variant = fit.files.size() > 1 ? samples.record.file + ", readings" : "readings",
           .width = 860.0};
  f.subtitle = samples.subtitle(fit);
  const std::vector<double> time = samples.of(samples.record.time, 1.0);
  Panel left = time_panel(samples, time);
  DisplayUnit left_unit;
  int color = 0;
  for (const FittedProbe& probe : fit.probes) {
    if (probe.record != number || !is_drawn(result, probe)) continue;
    const DisplayUnit unit = unit_of(probe);
    Panel p = time_panel(samples, time);
    p.y.title = with_unit(probe_name(probe), unit);
    p.curves = {path(time, samples.of(probe.predicted, unit.factor)),
                dots(time, samples.of(probe.measured, unit.factor))};
    f.panels.push_back(std::move(p));
    if (left.curves.empty()) left_unit = unit, left.y.title = with_unit("left", unit);
    Curve c{
        .name = "measured less found, " + probe.name, .paint = series_paint(color++), .x = time};
    c.y = samples.of(probe.measured - probe.predicted, left_unit.factor);
    c.width = 0.9;
    left.curves.push_back(std::move(c));
  }
  if (f.panels.empty()) return f;
  f.panels.push_back(std::move(left));
  f.height = 120.0 + 190.0 * static_cast<double>(f.panels.size());
  f.table = parameter_table(fit);
  f.notes = fit_notes(fit);
  return f;
}

std::vector<Figure> fit_figures(const ResultView& result) {
  const auto& fit = result_of<MeasuredFit>(result);
  std::vector<Figure> figures;
  for (const FittedStation& s : fit.stations) figures.push_back(fitted_orbit(fit, s));
  for (int i = 0; i < static_cast<int>(fit.files.size()); ++i) {
    Figure f = fitted_readings(result, fit, i);
    if (!f.panels.empty()) figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind fit_kind() {
  return {
      .name = "fit",
      .title = "Fit",
      .summary = "measured orbits and readings beside those of the motions that were found",
      .needs = {dataset_of<MeasuredFit>(&FittedProbe::predicted),
                dataset_of<MeasuredFit>(&FittedStation::x)},
      .make = fit_figures,
  };
}

}  // namespace whirl::inline io
