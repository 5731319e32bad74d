// Floquet multipliers of an orbit in the plane of complex numbers.

#include <fmt/format.h>

#include <cmath>

#include "libdyn/studies/orbit_result.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

std::vector<Figure> multiplier_figures(const ResultView& result) {
  const auto& orbit = result_of<OrbitResult>(result);
  if (orbit.multipliers.size() == 0) return {};
  Figure f{.width = 560.0, .height = 580.0};
  f.subtitle = fmt::format("Floquet multipliers{}: stable within the circle", at_speed(result));
  f.table.header = {"multiplier", "real", "imaginary", "size"};
  Panel p;
  p.has_equal_scales = true;
  p.x.title = "real";
  p.y.title = "imaginary";
  p.curves.push_back(circle("size 1", 1.0));
  double reach = 1.0;
  for (const bool is_inside : {true, false}) {
    Curve c{.name = is_inside ? "stable" : "unstable",
            .paint = is_inside ? Paint::forward : Paint::alarm,
            .has_line = false};
    c.has_marker = true;
    c.marker = is_inside ? Marker::circle : Marker::cross;
    c.size = 8.0;
    for (Eigen::Index i = 0; i < orbit.multipliers.size(); ++i) {
      const Complex m = orbit.multipliers(i);
      if ((std::abs(m) <= 1.0) != is_inside) continue;
      c.x.push_back(m.real());
      c.y.push_back(m.imag());
      c.hover.push_back(
          fmt::format("{:.6g} {:+.6g} i, size {:.6g}", m.real(), m.imag(), std::abs(m)));
      reach = std::max(reach, std::abs(m));
    }
    if (!c.x.empty()) p.curves.push_back(std::move(c));
  }
  constexpr Eigen::Index most = 12;
  for (Eigen::Index i = 0; i < std::min(most, orbit.multipliers.size()); ++i) {
    const Complex m = orbit.multipliers(i);
    f.table.rows.push_back({std::to_string(i + 1), fmt::format("{:.6g}", m.real()),
                            fmt::format("{:.6g}", m.imag()), fmt::format("{:.6g}", std::abs(m))});
  }
  if (orbit.multipliers.size() > most) {
    f.notes.push_back(
        fmt::format("The {} largest of {} in the table.", most, orbit.multipliers.size()));
  }
  p.x.first = p.y.first = -1.15 * reach;
  p.x.last = p.y.last = 1.15 * reach;
  f.panels.push_back(std::move(p));
  return {f};
}

}  // namespace

FigureKind multipliers_kind() {
  return {
      .name = "multipliers",
      .title = "Floquet multipliers",
      .summary = "multipliers of a periodic orbit beside the circle of stability",
      .needs = {dataset_of<OrbitResult>(&OrbitResult::multipliers)},
      .make = multiplier_figures,
  };
}

}  // namespace whirl::inline io
