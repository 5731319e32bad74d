#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/branch_lines.hpp"
#include "libio/results/call.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Names of the stations or contacts of a group that may have none.
std::vector<std::string> names_of(const ResultView& result, const std::string& path) {
  return result.file.has(path) ? result.file.strings(path) : std::vector<std::string>{};
}

/// A multiplier as people write it: "-1.02"; a pair with its size: "0.3 ± 0.4 i (0.5)".
std::string told(const Complex& m) {
  if (m.imag() == 0.0) return with_minus(fmt::format("{:.5g}", m.real()));
  return with_minus(
      fmt::format("{:.5g} ± {:.5g} i ({:.5g})", m.real(), std::abs(m.imag()), std::abs(m)));
}

/// The points of every branch: a click tells their multipliers and how to get their orbits.
void add_points(Panel& p, const ResultView& result, const BranchPoints& b,
                const std::vector<double>& y, const CMat& multipliers) {
  const auto contacts = names_of(result, "/branch/contact");
  const bool has_contacts = !contacts.empty();
  const Mat duty = has_contacts ? result.file.matrix("/branch/duty") : Mat();
  const Mat impacts = has_contacts ? result.file.matrix("/branch/impacts_per_rev") : Mat();
  const Mat normal = has_contacts ? result.file.matrix("/branch/max_normal") : Mat();
  const std::string command =
      fmt::format("{} --from {} --point {{n}}",
                  command_on_model(result, "orbit", {"method", "harmonics", "frame", "tolerance"}),
                  shell_word(result.path));
  for (std::size_t number = 1; number <= b.period.size(); ++number) {
    Curve c{.paint = series_paint(number - 1), .has_line = false, .has_marker = true};
    c.size = 4.0;
    c.along_title = "point";
    if (std::floor(b.period[number - 1]) == b.period[number - 1]) c.command = command;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.branch[i] != static_cast<double>(number)) continue;
      c.x.push_back(b.axis.values[i]);
      c.y.push_back(y[i]);
      c.along.push_back(static_cast<double>(i + 1));
      const auto k = static_cast<Eigen::Index>(i);
      std::string text = fmt::format("Point {} of branch {}: {} = {:.8g}, period {:.4g}, {}", i + 1,
                                     number, b.axis.title, b.axis.values[i], b.period[number - 1],
                                     b.stable[i] < 0.0   ? "begins on another branch"
                                     : b.stable[i] > 0.0 ? "stable"
                                                         : "unstable");
      std::string list;
      constexpr Eigen::Index most = 8;
      for (Eigen::Index j = 0; j < std::min(most, multipliers.cols()); ++j) {
        if (!std::isfinite(multipliers(k, j).real()) || multipliers(k, j).imag() < 0.0) continue;
        list += (list.empty() ? "" : ", ") + told(multipliers(k, j));
      }
      if (!list.empty()) {
        text += (multipliers.cols() > most ? "\nlargest multipliers: " : "\nmultipliers: ") + list;
      }
      for (std::size_t j = 0; j < contacts.size(); ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        text += fmt::format("\n{}: {:.4g} % in touch, {:.4g} impacts per revolution, up to {}",
                            contacts[j], 100.0 * duty(k, at), impacts(k, at),
                            format_engineering(normal(k, at), "N"));
      }
      c.details.push_back(std::move(text));
    }
    p.curves.push_back(std::move(c));
  }
}

std::vector<Figure> branch_figures(const ResultView& result) {
  const BranchPoints b(result);
  if (b.size() < 2) return {};
  const auto stations = names_of(result, "/branch/station");
  const auto contacts = names_of(result, "/branch/contact");
  const auto panel = [&](const std::string& title) {
    Panel p;
    p.x.title = b.axis.title;
    p.y.title = title;
    p.cursor = "parameter";
    return p;
  };
  const CMat all = result.file.complex_matrix("/branch/multiplier");

  std::vector<Figure> figures;
  for (const std::size_t s : stations_by_interest(result, stations)) {
    Figure f{.variant = stations[s], .height = contacts.empty() ? 560.0 : 780.0};
    f.subtitle = fmt::format("{}: periodic orbits along {}", stations[s], b.axis.path);
    std::vector<double> radius = column_of(result, "/branch/max_radius", s);
    const DisplayUnit unit = unit_for(largest_of(radius), "m");
    radius = scaled(std::move(radius), unit.factor);
    Panel p = panel(with_unit("largest distance from the axis", unit));
    p.share = 2.4;
    add_branch_lines(p, b, radius, {.is_named = true});
    add_points(p, result, b, radius, all);
    add_branch_marks(p, b, radius);
    f.panels.push_back(std::move(p));
    Panel m = panel("largest multiplier");
    m.y.first = 0.0;
    m.rules.push_back({Rule::Kind::horizontal, 1.0, "", Paint::ink, Dash::solid});
    add_branch_lines(m, b, largest_multipliers(result), {});
    f.panels.push_back(std::move(m));
    if (!contacts.empty()) {
      Panel d = panel(contacts.size() > 1 ? contacts[0] + ": share in touch" : "share in touch");
      d.y.first = 0.0;
      add_branch_lines(d, b, column_of(result, "/branch/duty", 0), {});
      f.panels.push_back(std::move(d));
    }
    f.notes.push_back("Solid: stable, dashed: unstable. Dots are the points that were computed.");
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind branches_kind() {
  return {
      .name = "branches",
      .title = "Branches",
      .summary = "periodic orbits along a parameter, stable and unstable, with their bifurcations",
      .needs = {"/branch/max_radius"},
      .make = branch_figures,
  };
}

}  // namespace whirl::inline io
