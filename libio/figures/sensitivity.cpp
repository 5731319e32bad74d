#include "libdyn/linear/sensitivity.hpp"

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

constexpr std::size_t most_curves = 8;

std::vector<double> decibels(const CVec& values) {
  std::vector<double> list;
  for (const Complex& v : values) {
    list.push_back(std::abs(v) > 0.0 ? 20.0 * std::log10(std::abs(v)) : not_set);
  }
  return list;
}

/// Size of the sensitivity or of the open loop in dB.
Figure figure_of(const ResultView& result, const Sensitivity& found, const char* name,
                 CVec LoopSensitivity::*values) {
  Figure f{.variant = name, .height = 420.0};
  f.subtitle = fmt::format("at {}", shown_value(found.speed, "rpm", ".0f"));
  const DisplayUnit in = result.frequency;
  Panel panel;
  panel.x = {.title = with_unit("frequency", in),
             .first = found.frequencies.front() * in.factor,
             .last = found.frequencies.back() * in.factor};
  panel.cursor = "frequency";
  panel.y = {.title = fmt::format("{} [dB]", name)};
  if (values == &LoopSensitivity::sensitivity) {
    const char* zones[] = {"A", "B", "C"};
    for (std::size_t k = 0; k < std::size(zone_limits); ++k) {
      panel.rules.push_back({Rule::Kind::horizontal, 20.0 * std::log10(zone_limits[k]),
                             fmt::format("end of zone {}", zones[k]), Paint::gray, Dash::dashed});
    }
  }
  for (std::size_t i = 0; i < std::min(most_curves, found.loops.size()); ++i) {
    const LoopSensitivity& loop = found.loops[i];
    Curve c{.name = loop.label(),
            .paint = series_paint(i),
            .x = scaled(found.frequencies, in.factor),
            .y = decibels(loop.*values)};
    c.dash = series_dash(i);
    panel.curves.push_back(std::move(c));
  }
  f.panels = {panel};
  if (found.loops.size() > most_curves) {
    f.notes.push_back(fmt::format("The first {} of {} loops.", most_curves, found.loops.size()));
  }
  return f;
}

std::vector<Figure> sensitivity_figures(const ResultView& result) {
  const auto& found = result_of<Sensitivity>(result);
  return {figure_of(result, found, "sensitivity", &LoopSensitivity::sensitivity),
          figure_of(result, found, "open loop", &LoopSensitivity::open_loop)};
}

}  // namespace

FigureKind sensitivity_kind() {
  return {
      .name = "sensitivity",
      .title = "Sensitivity of control loops",
      .summary = "sensitivity and open loop of magnetic bearings over frequency",
      .needs = {dataset_of<Sensitivity>(&LoopSensitivity::sensitivity)},
      .make = sensitivity_figures,
  };
}

}  // namespace whirl::inline io
