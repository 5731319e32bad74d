// Forces on bearings, seals, links and oil films, over speed and in time.

#include <fmt/format.h>

#include <cmath>

#include "libbase/structs/names.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Largest force in a period at each speed [N]: the major semi-axis of its ellipse.
std::vector<double> largest_forces(const CVec& x, const CVec& y) {
  std::vector<double> sizes;
  for (Eigen::Index k = 0; k < x.size(); ++k) sizes.push_back(Orbit(x(k), y(k)).major());
  return sizes;
}

std::vector<Figure> support_force_figures(const ResultView& result) {
  const auto& study = result_of<UnbalanceStudy>(result);
  if (study.bearings.empty()) return {};
  Figure f{.height = 420.0};
  f.subtitle = "Forces of the unbalance on supports, largest in a revolution, without the weight";
  f.table.header = {"support", shown_heading("largest", "N"), shown_heading("at", "rpm")};
  std::vector<Curve> curves;
  double largest = 0.0;
  for (const BearingResponse& b : study.bearings) {
    const bool has_curve = b.curve_x.size() == std::ssize(study.curve_speeds) &&
                           b.curve_y.size() == b.curve_x.size() && b.curve_x.size() > 0;
    const std::vector<double>& speeds = has_curve ? study.curve_speeds : study.speeds;
    const CVec &x = has_curve ? b.curve_x : b.x, &y = has_curve ? b.curve_y : b.y;
    if (x.size() != std::ssize(speeds) || y.size() != x.size()) {
      throw FileError("the forces on supports are not of their speeds");
    }
    Curve c{.name = named(b.kind, b.name), .paint = series_paint(curves.size())};
    c.dash = series_dash(curves.size());
    c.width = 1.8;
    c.x = scaled(speeds, 1.0 / speed_unit().size);
    c.y = largest_forces(x, y);
    largest = std::max(largest, largest_of(c.y));
    f.table.rows.push_back(
        {c.name, shown_digits(b.largest, "N", 4), shown_number(b.largest_at, "rpm", ".0f")});
    curves.push_back(std::move(c));
  }
  const DisplayUnit unit = unit_for(largest, "N");
  Panel p;
  p.x.title = shown_heading("speed", "rpm");
  p.x.first = curves.front().x.front();
  p.x.last = curves.front().x.back();
  p.y = {.title = with_unit("force", unit), .first = 0.0};
  p.cursor = "speed";
  for (Curve& c : curves) {
    c.y = scaled(std::move(c.y), unit.factor);
    p.curves.push_back(std::move(c));
  }
  const double speed = speed_of(result) / speed_unit().size;
  if (std::isfinite(speed) && speed > p.x.first && speed < p.x.last) {
    p.rules.push_back({Rule::Kind::vertical, speed, "operating speed", Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  return {f};
}

/// Forces on all supports in time, along x and along y.
std::vector<Figure> support_history_figures(const ResultView& result) {
  const Motion m(result);
  const std::vector<SupportForce>& supports = m.record.supports;
  if (supports.empty()) return {};
  const MotionSamples drawn = m.drawn(seen_revolutions);
  double largest = 0.0;
  for (const SupportForce& s : supports) {
    if (s.x.size() != m.size() || s.y.size() != m.size()) {
      throw FileError("the forces on supports are not of the samples of the motion");
    }
    largest = std::max({largest, s.x.cwiseAbs().maxCoeff(), s.y.cwiseAbs().maxCoeff()});
  }
  const DisplayUnit unit = unit_for(largest, "N");
  Figure f{.height = 500.0};
  f.subtitle = fmt::format("Forces of the rotor on its supports{}", at_speed(result));
  for (const auto& [name, along] :
       {std::pair{"along x", &SupportForce::x}, std::pair{"along y", &SupportForce::y}}) {
    Panel p;
    m.show_over_time(p, seen_revolutions);
    p.y.title = with_unit(name, unit);
    for (std::size_t i = 0; i < supports.size(); ++i) {
      Curve c{.name = named(supports[i].kind, supports[i].name),
              .paint = series_paint(i),
              .x = numbers(m.time, drawn)};
      c.y = scaled(numbers(supports[i].*along, drawn), unit.factor);
      c.width = 1.3;
      c.dash = series_dash(i);
      p.curves.push_back(std::move(c));
    }
    f.panels.push_back(std::move(p));
  }
  f.notes = m.time_notes(seen_revolutions);
  return {f};
}

}  // namespace

FigureKind support_history_kind() {
  return {
      .name = "support_history",
      .title = "Forces on supports in time",
      .summary = "forces on bearings, seals, links and oil films in time",
      .needs = {dataset_of<MotionRecord>(&SupportForce::x)},
      .make = support_history_figures,
      .takes_window = true,
  };
}

FigureKind support_forces_kind() {
  return {
      .name = "support_forces",
      .title = "Forces on supports",
      .summary = "forces of the unbalance on bearings, seals, links and oil films over speed",
      .needs = {dataset_of<UnbalanceStudy>(&BearingResponse::x)},
      .make = support_force_figures,
  };
}

}  // namespace whirl::inline io
