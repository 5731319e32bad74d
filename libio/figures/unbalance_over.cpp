#include "libdyn/linear/unbalance_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libfe/assembly/excitations.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Sizes over the values in one panel, a color for each: solid the largest over all speeds, dashed
/// at the operating speed.
class SizePanel {
 public:
  SizePanel(const ShownAxis& axis, const std::string& title, const DisplayUnit& unit)
      : values_(axis.values), unit_(unit) {
    panel_.x = {.title = axis.title, .first = axis.values.front(), .last = axis.values.back()};
    panel_.y = {.title = with_unit(title, unit), .scale = Scale::logarithmic};
    panel_.cursor = "parameter";
  }

  void add(const std::string& name, const Vec& largest, const Vec& at_operation, double factor) {
    if (largest.size() != std::ssize(values_) || at_operation.size() != largest.size()) {
      throw FileError("the responses are not of their values");
    }
    Curve c{.name = name, .paint = series_paint(count_++), .x = values_};
    c.y = scaled(numbers(largest), factor * unit_.factor);
    c.width = 1.8;
    Curve there = c;
    there.name = "at the operating speed";
    there.dash = Dash::dashed;
    there.width = 1.2;
    there.y = scaled(numbers(at_operation), factor * unit_.factor);
    panel_.curves.push_back(std::move(c));
    const bool is_told =
        std::any_of(there.y.begin(), there.y.end(), [](double y) { return std::isfinite(y); });
    if (is_told) panel_.curves.push_back(std::move(there));
  }

  const DisplayUnit& unit() const { return unit_; }
  Panel take() { return std::move(panel_); }

 private:
  std::vector<double> values_;
  DisplayUnit unit_;
  Panel panel_;
  std::size_t count_ = 0;
};

/// Where the peaks are, larger ones with larger marks.
Panel peaks_panel(const ResultView& result, const UnbalanceOver& found, const ShownAxis& axis) {
  Panel p;
  p.x = {.title = axis.title, .first = axis.values.front(), .last = axis.values.back()};
  p.y.title = shown_heading("peaks", "rpm");
  p.cursor = "parameter";
  Curve c{.name = "peak", .paint = Paint::ink, .has_line = false};
  c.has_marker = true;
  c.size = 4.0;
  for (const UnbalanceOverPeak& peak : found.peaks) {
    c.x.push_back(peak.value / axis.factor);
    c.y.push_back(peak.speed / speed_unit().size);
    c.hover.push_back(fmt::format("{} at {:.5g}: amplification {:.4g}",
                                  shown_value(peak.speed, "rpm", ".1f"), c.x.back(),
                                  peak.amplification()));
  }
  p.curves.push_back(std::move(c));
  const double speed = speed_of(result) / speed_unit().size;
  if (std::isfinite(speed) && speed > 0.0) {
    p.rules.push_back({Rule::Kind::horizontal, speed, "operating", Paint::gray, Dash::dotted});
  }
  return p;
}

std::vector<Figure> unbalance_over_figures(const ResultView& result) {
  const auto& found = result_of<UnbalanceOver>(result);
  const ShownAxis axis = shown_axis(result, dataset_of<UnbalanceOver>(&OverValues::values));
  Figure f{.height = 560.0};
  f.subtitle = "Largest unbalance response, peak to peak, over " + axis.path;
  double top = 0.0;
  for (const UnbalanceOverStation& s : found.stations) {
    top = std::max(top, largest_of(numbers(s.largest)));
  }
  constexpr double peak_to_peak = 2.0;  // of a semi-axis
  SizePanel stations(axis, "major axis p-p", unit_for(peak_to_peak * top, "m"));
  for (const UnbalanceOverStation& s : found.stations) {
    stations.add(s.station, s.largest, s.at_operation, peak_to_peak);
  }
  std::vector<SizePanel> probes;
  for (const UnbalanceOverProbe& probe : found.probes) {
    if (!is_drawn(result, probe)) continue;
    f.probes.push_back(probe.name);
    auto panel = std::find_if(probes.begin(), probes.end(),
                              [&](const SizePanel& p) { return p.unit().name == probe.unit; });
    if (panel == probes.end()) {
      panel = probes.insert(probes.end(), SizePanel(axis, "probes p-p", unit_of(probe)));
    }
    panel->add(probe_name(probe), probe.largest, probe.at_operation, 1.0);
  }
  for (SizePanel& panel : probes) f.panels.push_back(panel.take());
  f.panels.push_back(stations.take());
  if (!found.peaks.empty()) f.panels.push_back(peaks_panel(result, found, axis));
  f.height = 120.0 + 220.0 * static_cast<double>(f.panels.size());
  if (result.model && has_oscillating_force(result.model->structure)) {
    f.notes.push_back(
        "At the frequency of the speed; responses to forces of other frequencies are not drawn.");
  }
  return {f};
}

}  // namespace

FigureKind unbalance_over_kind() {
  return {
      .name = "unbalance_over",
      .title = "Unbalance response over a value",
      .summary = "largest response and its peaks over a value of the model",
      .needs = {dataset_of<UnbalanceOver>(&UnbalanceOverStation::largest)},
      .make = unbalance_over_figures,
  };
}

}  // namespace whirl::inline io
