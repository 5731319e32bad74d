#include "libdyn/linear/critical_over.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

std::vector<Figure> critical_over_figures(const ResultView& result) {
  const auto& found = result_of<CriticalOver>(result);
  const ShownAxis axis = shown_axis(result, dataset_of<CriticalOver>(&OverValues::values));
  Figure f{.height = 480.0};
  f.subtitle = "Critical speeds over " + axis.path;
  Panel p;
  p.x = {.title = axis.title, .first = axis.values.front(), .last = axis.values.back()};
  p.y = {.title = shown_heading("critical speed", "rpm"), .first = 0.0};
  p.cursor = "parameter";
  for (std::size_t i = 0; i < found.branches.size(); ++i) {
    const CriticalOverBranch& branch = found.branches[i];
    if (branch.speed.size() != std::ssize(axis.values) ||
        branch.damped_speed.size() != branch.speed.size()) {
      throw FileError("the critical speeds are not of their values");
    }
    const WhirlStyle style = whirl_style(branch.whirl);
    Curve c{.name = style.name,
            .end_name = fmt::format("{}{}", i + 1, style.letter),
            .paint = style.paint,
            .x = axis.values};
    c.y = scaled(numbers(branch.speed), 1.0 / speed_unit().size);
    c.width = 1.8;
    c.dash = style.dash;
    Curve damped{.name = "damped", .paint = style.paint, .x = axis.values, .has_line = false};
    damped.y = scaled(numbers(branch.damped_speed), 1.0 / speed_unit().size);
    damped.has_marker = true;
    damped.marker = style.marker;
    damped.size = 5.0;
    damped.marker_every = std::max<std::size_t>(1, axis.values.size() / 12);
    p.curves.push_back(std::move(c));
    p.curves.push_back(std::move(damped));
  }
  const double speed = speed_of(result) / speed_unit().size;
  if (std::isfinite(speed) && speed > 0.0) {
    p.rules.push_back({Rule::Kind::horizontal, speed, "operating", Paint::gray, Dash::dotted});
  }
  f.panels = {std::move(p)};
  return {f};
}

}  // namespace

FigureKind critical_over_kind() {
  return {
      .name = "critical_over",
      .title = "Critical speeds over a value",
      .summary = "critical speeds over a value of the model",
      .needs = {dataset_of<CriticalOver>(&CriticalOverBranch::speed)},
      .make = critical_over_figures,
  };
}

}  // namespace whirl::inline io
