#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/branch_lines.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/results/call.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// A multiplier as people write it: "-1.02"; a pair with its size: "0.3 ± 0.4 i (0.5)".
std::string told(const Complex& m) {
  if (m.imag() == 0.0) return with_minus(fmt::format("{:.5g}", m.real()));
  return with_minus(
      fmt::format("{:.5g} ± {:.5g} i ({:.5g})", m.real(), std::abs(m.imag()), std::abs(m)));
}

std::string multipliers_text(const BranchOrbit& point) {
  constexpr Eigen::Index most = 8;
  const CVec& all = point.multipliers;
  std::string list;
  for (const Complex& m : all.head(std::min(most, all.size()))) {
    if (!std::isfinite(m.real()) || m.imag() < 0.0) continue;
    list += (list.empty() ? "" : ", ") + told(m);
  }
  if (list.empty()) return "";
  return (all.size() > most ? "\nlargest multipliers: " : "\nmultipliers: ") + list;
}

std::string contacts_text(const std::vector<std::string>& contacts, const BranchOrbit& point) {
  std::string text;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    text += fmt::format("\n{}: {:.4g} % in touch, {:.4g} impacts per revolution, up to {}",
                        contacts[j], 100.0 * point.duty.at(j), point.impacts.at(j),
                        format_engineering(point.max_normal.at(j), "N"));
  }
  return text;
}

/// The points of every branch: a click tells their multipliers and how to get their orbits.
void add_points(Panel& p, const ResultView& result, const BranchPoints& b,
                const std::vector<double>& y) {
  const std::string command =
      fmt::format("{} --from {} --point {{n}}",
                  command_on_model(result, "orbit", {"method", "harmonics", "frame", "tolerance"}),
                  without_places(shell_word(result.path)));
  for (std::size_t number = 1; number <= b.period.size(); ++number) {
    Curve c{.paint = series_paint(number - 1), .has_line = false, .has_marker = true};
    c.size = 4.0;
    c.along_title = "point";
    if (std::floor(b.period[number - 1]) == b.period[number - 1]) c.command = command;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const BranchOrbit& point = b.of.points[i];
      if (point.branch != static_cast<int>(number)) continue;
      c.x.push_back(b.axis.values[i]);
      c.y.push_back(y[i]);
      c.along.push_back(static_cast<double>(i + 1));
      std::string text = fmt::format("Point {} of branch {}: {} = {:.8g}, period {:.4g}, {}", i + 1,
                                     number, b.axis.title, b.axis.values[i], b.period[number - 1],
                                     point.stability < 0   ? "begins on another branch"
                                     : point.stability > 0 ? "stable"
                                                           : "unstable");
      c.details.push_back(text + multipliers_text(point) + contacts_text(b.of.contacts, point));
    }
    p.curves.push_back(std::move(c));
  }
}

/// A figure of the branches along what its first panel shows.
/// @param sizes  a number per point, as shown
Figure figure_of(const ResultView& result, const BranchPoints& b, const std::string& variant,
                 const std::string& title, const std::vector<double>& sizes) {
  const std::vector<std::string>& contacts = b.of.contacts;
  const auto panel = [&](const std::string& name) {
    Panel p;
    p.x.title = b.axis.title;
    p.y.title = name;
    p.cursor = "parameter";
    return p;
  };
  Figure f{.variant = variant, .height = contacts.empty() ? 560.0 : 780.0};
  f.subtitle = fmt::format("{}: periodic orbits along {}", variant, b.axis.path);
  Panel p = panel(title);
  p.share = 2.4;
  add_branch_lines(p, b, sizes, {.is_named = true});
  add_points(p, result, b, sizes);
  add_branch_marks(p, b, sizes);
  f.panels.push_back(std::move(p));
  Panel m = panel("largest multiplier");
  m.y.first = 0.0;
  m.rules.push_back({Rule::Kind::horizontal, 1.0, "", Paint::ink, Dash::solid});
  add_branch_lines(m, b, b.numbers(largest_multiplier), {});
  f.panels.push_back(std::move(m));
  if (!contacts.empty()) {
    Panel d = panel(contacts.size() > 1 ? contacts[0] + ": share in touch" : "share in touch");
    d.y.first = 0.0;
    add_branch_lines(d, b, b.numbers(&BranchOrbit::duty, 0), {});
    f.panels.push_back(std::move(d));
  }
  f.notes.push_back("Solid: stable, dashed: unstable. Dots are the points that were computed.");
  return f;
}

std::vector<Figure> branch_figures(const ResultView& result) {
  const BranchPoints b(result);
  if (b.size() < 2) return {};
  std::vector<Figure> figures;
  for (const std::size_t i : drawn_probes(result, b.of.probes)) {
    const ProbeLabel probe = b.of.probes[i];
    const DisplayUnit unit = unit_of(probe);
    Figure f = figure_of(result, b, probe_name(probe), with_unit("peak to peak", unit),
                         scaled(b.numbers(&BranchOrbit::probe_peak_to_peak, i), unit.factor));
    f.probes = {probe.name};
    figures.push_back(std::move(f));
  }
  for (const std::size_t s : stations_by_interest(result, b.of.stations)) {
    std::vector<double> radii = b.numbers(&BranchOrbit::radii, s);
    const DisplayUnit unit = unit_for(largest_of(radii), "m");
    figures.push_back(figure_of(result, b, b.of.stations[s],
                                with_unit("largest distance from the axis", unit),
                                scaled(std::move(radii), unit.factor)));
  }
  return figures;
}

}  // namespace

FigureKind branches_kind() {
  return {
      .name = "branches",
      .title = "Branches",
      .summary = "periodic orbits along a parameter, stable and unstable, with their bifurcations",
      .needs = {dataset_of<BranchResult>(&BranchOrbit::radii)},
      .make = branch_figures,
  };
}

}  // namespace whirl::inline io
