// Laws of supports over the samples that they were fitted to.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/support_fits.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr std::size_t most_entries = 16;  ///< of the matrix of a support

using StiffnessPoints = std::vector<StiffnessPoint>;

/// Points of one entry of one support.
StiffnessPoints entry_points(const StiffnessPoints& all, const StiffnessPoint& like) {
  StiffnessPoints found;
  std::ranges::copy_if(all, std::back_inserter(found), [&](const StiffnessPoint& p) {
    return p.support == like.support && p.row == like.row && p.column == like.column;
  });
  return found;
}

/// Adds points to the panels of amplitude and phase.
/// @param per_unit  of the stiffness that is shown [m/N]
void add_stiffness_curves(const StiffnessPoints& points, Curve look, double per_hz, double per_unit,
                          Panel& amplitude, Panel& phase) {
  for (const StiffnessPoint& p : points) look.x.push_back(p.frequency * per_hz);
  Curve angle = look;
  for (const StiffnessPoint& p : points) {
    const double size = std::abs(p.value());
    look.y.push_back(size > 0.0 ? size * per_unit : not_set);
    angle.y.push_back(size > 0.0 ? std::arg(p.value()) / degree : not_set);
  }
  // a line is interrupted where the phase leaves its range
  for (std::size_t i = 1; angle.has_line && i < angle.y.size(); ++i) {
    if (std::abs(angle.y[i] - angle.y[i - 1]) > 180.0) angle.y[i - 1] = not_set;
  }
  amplitude.curves.push_back(std::move(look));
  phase.curves.push_back(std::move(angle));
}

Figure entry_figure(const ResultView& result, const SupportFits& found, const StiffnessPoint& entry,
                    bool is_only) {
  const SupportFit& fit = found.fits[static_cast<std::size_t>(entry.support)];
  const StiffnessPoints samples = entry_points(found.samples, entry),
                        law = entry_points(found.curve, entry);
  Figure f{.variant = is_only ? fit.name
                              : fmt::format("{} {}{}", fit.name, entry.row + 1, entry.column + 1),
           .height = 520.0};
  f.subtitle = fmt::format("{}: {} poles, error {:.2g} (root mean square, relative)", f.variant,
                           fit.poles, fit.error);
  const DisplayUnit in = result.frequency;
  Panel amplitude, phase;
  for (Panel* p : {&amplitude, &phase}) {
    p->x = {.title = with_unit("frequency", in),
            .first = samples.front().frequency * in.factor,
            .last = samples.back().frequency * in.factor};
    p->cursor = "frequency";
  }
  amplitude.share = 1.5;
  amplitude.y = {.title = shown_heading("dynamic stiffness", "N/m"), .scale = Scale::logarithmic};
  phase.y = {.title = "phase [deg]", .first = -180.0, .last = 180.0, .step = 90.0};
  const double per_unit = 1.0 / shown_unit("N/m").size;
  Curve fitted{.name = "law", .paint = series_paint(0)};
  Curve measured{.name = "samples", .paint = series_paint(1)};
  measured.has_line = false;
  measured.has_marker = true;
  measured.size = 4.0;
  add_stiffness_curves(samples, measured, in.factor, per_unit, amplitude, phase);
  add_stiffness_curves(law, fitted, in.factor, per_unit, amplitude, phase);
  f.panels = {std::move(amplitude), std::move(phase)};
  f.notes.push_back(fmt::format("{} samples; at most {:.2g} is left, at {}.", fit.samples,
                                fit.largest, shown_value(fit.largest_at, "Hz", ".4g")));
  constexpr double rounding = 1e-9;
  if (fit.mirrored > 0) f.notes.push_back(fmt::format("{} poles were made stable.", fit.mirrored));
  if (fit.least_damping < -rounding) {
    f.notes.push_back(fmt::format("Not passive: it gives energy to motions at {}.",
                                  shown_value(fit.least_damping_at, "Hz", ".4g")));
  }
  return f;
}

std::vector<Figure> support_fit_figures(const ResultView& result) {
  const auto& found = result_of<SupportFits>(result);
  std::vector<Figure> figures;
  for (std::size_t number = 0; number < found.fits.size(); ++number) {
    StiffnessPoints entries;
    for (const StiffnessPoint& p : found.samples) {
      const bool is_new =
          entries.empty() || entries.back().row != p.row || entries.back().column != p.column;
      if (p.support == static_cast<int>(number) && is_new) entries.push_back(p);
    }
    if (entries.size() > most_entries) throw FileError("the samples of a law are in no order");
    for (const StiffnessPoint& entry : entries) {
      figures.push_back(entry_figure(result, found, entry, entries.size() == 1));
    }
  }
  return figures;
}

}  // namespace

FigureKind support_fit_kind() {
  return {
      .name = "support_fit",
      .title = "Fitted laws of supports",
      .summary = "samples of a response and the law that is fitted to them: amplitude and phase",
      .needs = {dataset_of<SupportFits>(&StiffnessPoint::frequency)},
      .make = support_fit_figures,
  };
}

}  // namespace whirl::inline io
