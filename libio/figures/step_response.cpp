#include "libdyn/linear/step_response.hpp"

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

constexpr std::size_t most_steps = 8;

/// Displacements after a step.
Panel panel_of(const StepResponse& found, const char* title, const char* y, double factor,
               Vec LoopStep::*response, double LoopStep::*end) {
  Panel panel;
  panel.title = title;
  panel.cursor = "time";
  panel.x = {.title = "time [ms]", .first = 0.0, .last = 1e3 * found.times.back()};
  panel.y = {.title = y};
  std::vector<double> ends;
  for (std::size_t i = 0; i < std::min(most_steps, found.steps.size()); ++i) {
    const LoopStep& step = found.steps[i];
    Curve c{.name = step.label(), .paint = series_paint(i), .x = scaled(found.times, 1e3)};
    for (const double value : step.*response) c.y.push_back(factor * value);
    c.dash = series_dash(i);
    panel.curves.push_back(std::move(c));
    const double at = factor * step.*end;
    const bool is_known = std::ranges::any_of(
        ends, [&](double other) { return std::abs(other - at) <= 1e-6 * std::abs(at); });
    if (!std::isfinite(at) || is_known) continue;
    ends.push_back(at);
    panel.rules.push_back(
        {Rule::Kind::horizontal, at, i == 0 ? "in the end" : "", Paint::gray, Dash::dashed});
  }
  return panel;
}

std::vector<Figure> step_response_figures(const ResultView& result) {
  const auto& found = result_of<StepResponse>(result);
  Figure f{.width = 900.0, .height = 420.0};
  f.columns = 2;
  f.subtitle = fmt::format("at {}", shown_value(found.speed, "rpm", ".0f"));
  f.panels = {panel_of(found, "of the reference", "displacement over reference", 1.0,
                       &LoopStep::reference, &LoopStep::reference_end),
              panel_of(found, "of a force", "displacement over force [µm/N]", 1e6, &LoopStep::force,
                       &LoopStep::force_end)};
  if (found.steps.size() > most_steps) {
    f.notes.push_back(fmt::format("The first {} of {} loops.", most_steps, found.steps.size()));
  }
  return {f};
}

}  // namespace

FigureKind step_response_kind() {
  return {
      .name = "step_response",
      .title = "Step responses of control loops",
      .summary =
          "displacement at the sensors of magnetic bearings after a step of reference or "
          "force",
      .needs = {dataset_of<StepResponse>(&LoopStep::reference)},
      .make = step_response_figures,
  };
}

}  // namespace whirl::inline io
