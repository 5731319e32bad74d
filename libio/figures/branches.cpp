#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libio/figures/all.hpp"
#include "libio/format.hpp"

namespace whirl {

namespace {

using namespace figures;

/// Points of all branches, one after another, and what happens between them.
struct Branches {
  explicit Branches(const ResultView& result)
      : axis(shown_axis(result, "/branch/value")),
        branch(result.file.numbers("/branch/branch")),
        stable(result.file.numbers("/branch/stable")),
        period(result.file.numbers("/branch/period")) {
    if (!result.file.has("/branch/bifurcation")) return;
    bifurcation = scaled(result.file.numbers("/branch/bifurcation"), 1.0 / axis.factor);
    kind = result.file.strings("/branch/bifurcation_kind");
    on = result.file.numbers("/branch/bifurcation_branch");
    after = result.file.numbers("/branch/bifurcation_after");
  }
  ShownAxis axis;
  std::vector<double> branch, stable, period;
  std::vector<double> bifurcation, on, after;
  std::vector<std::string> kind;

  std::size_t size() const { return branch.size(); }
  /// Number of the point before a bifurcation, among those of all branches.
  std::size_t before(std::size_t b) const {
    const auto first = std::find(branch.begin(), branch.end(), on[b]) - branch.begin();
    return static_cast<std::size_t>(first) + static_cast<std::size_t>(after[b]) - 1;
  }
};

/// Names of the stations or contacts of a group that may have none.
std::vector<std::string> names_of(const ResultView& result, const std::string& path) {
  return result.file.has(path) ? result.file.strings(path) : std::vector<std::string>{};
}

/// Numbers of a column of a table with a row per point.
std::vector<double> column(const ResultView& result, const std::string& path, std::size_t i) {
  const std::vector<double> all = result.file.numbers(path);
  const auto width = static_cast<std::size_t>(result.file.shape(path).at(1));
  std::vector<double> values;
  for (std::size_t k = i; k < all.size(); k += width) values.push_back(all[k]);
  return values;
}

/// A place between points i and i + 1.
struct Between {
  double x, y;
};
Between place_of(const Branches& b, const std::vector<double>& y, std::size_t i, double x) {
  const double across = b.axis.values[i + 1] - b.axis.values[i];
  const double share = across == 0.0 ? 0.5 : std::clamp((x - b.axis.values[i]) / across, 0.0, 1.0);
  return {x, y[i] + share * (y[i + 1] - y[i])};
}

/// Lines through a number per point: solid where orbits are stable, dashed where they are not; they
/// change at the bifurcation between the points.
void add_lines(Panel& p, const Branches& b, const std::vector<double>& y, bool is_named) {
  std::map<std::pair<double, bool>, Curve> lines;
  const auto draw = [&](double branch, bool is_stable, Between from, Between to) {
    Curve& c = lines[{branch, is_stable}];
    if (c.x.empty() || c.x.back() != from.x || c.y.back() != from.y) {
      c.x.insert(c.x.end(), {not_set, from.x});
      c.y.insert(c.y.end(), {not_set, from.y});
    }
    c.x.push_back(to.x);
    c.y.push_back(to.y);
  };
  // a branch that begins on another has the stability that it begins with
  const auto is_stable = [&](std::size_t i) {
    return b.stable[b.stable[i] < 0.0 ? i + 1 : i] > 0.0;
  };
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    if (b.branch[i] != b.branch[i + 1]) continue;
    const Between from{b.axis.values[i], y[i]}, to{b.axis.values[i + 1], y[i + 1]};
    if (is_stable(i) == is_stable(i + 1)) {
      draw(b.branch[i], is_stable(i), from, to);
      continue;
    }
    Between change = place_of(b, y, i, 0.5 * (from.x + to.x));
    for (std::size_t k = 0; k < b.kind.size(); ++k) {
      if (b.before(k) == i && b.kind[k] != "grazing") change = place_of(b, y, i, b.bifurcation[k]);
    }
    draw(b.branch[i], is_stable(i), from, change);
    draw(b.branch[i], is_stable(i + 1), change, to);
  }
  for (auto& [key, c] : lines) {
    const auto [number, stays] = key;
    const double period = b.period[static_cast<std::size_t>(number) - 1];
    if (is_named) c.name = fmt::format("period {:.0f}, {}", period, stays ? "stable" : "unstable");
    c.paint = series_paint(static_cast<std::size_t>(number) - 1);
    c.dash = stays ? Dash::solid : Dash::dashed;
    c.width = stays ? 1.8 : 1.2;
    p.curves.push_back(std::move(c));
  }
}

/// Marks of bifurcations on the lines; small ones for grazings, of which there are many.
void add_marks(Panel& p, const Branches& b, const std::vector<double>& y) {
  struct Style {
    const char* kind;
    Marker marker;
    Paint paint;
    double size;
  };
  for (const Style& style : {Style{"fold", Marker::square, Paint::ink, 8.0},
                             Style{"period-doubling", Marker::diamond, Paint::alarm, 9.0},
                             Style{"neimark-sacker", Marker::circle, Paint::quasi_periodic, 9.0},
                             Style{"pitchfork", Marker::triangle, Paint::mixed, 9.0},
                             Style{"grazing", Marker::cross, Paint::gray, 6.0}}) {
    Curve c{.name = style.kind, .paint = style.paint, .has_line = false, .has_marker = true};
    c.marker = style.marker;
    c.size = style.size;
    for (std::size_t k = 0; k < b.kind.size(); ++k) {
      const std::size_t i = b.before(k);
      if (b.kind[k] != style.kind || i + 1 >= b.size()) continue;
      const Between at = place_of(b, y, i, b.bifurcation[k]);
      c.x.push_back(at.x);
      c.y.push_back(at.y);
      c.hover.push_back(fmt::format("{} at {:.7g}", style.kind, b.bifurcation[k]));
    }
    if (!c.x.empty()) p.curves.push_back(std::move(c));
  }
}

/// A multiplier as people write it: "-1.02"; a pair with its size: "0.3 ± 0.4 i (0.5)".
std::string told(const Complex& m) {
  if (m.imag() == 0.0) return with_minus(fmt::format("{:.5g}", m.real()));
  return with_minus(
      fmt::format("{:.5g} ± {:.5g} i ({:.5g})", m.real(), std::abs(m.imag()), std::abs(m)));
}

/// The points of every branch: a click tells their multipliers and how to get their orbits.
void add_points(Panel& p, const ResultView& result, const Branches& b, const std::vector<double>& y,
                const CMat& multipliers) {
  const auto contacts = names_of(result, "/branch/contact");
  const bool has_contacts = !contacts.empty();
  const Mat duty = has_contacts ? result.file.matrix("/branch/duty") : Mat();
  const Mat impacts = has_contacts ? result.file.matrix("/branch/impacts_per_rev") : Mat();
  const Mat normal = has_contacts ? result.file.matrix("/branch/max_normal") : Mat();
  const std::string command = fmt::format("whirl orbit {}{} --from {} --point {{n}}",
                                          result.model_path, settings_of(result), result.path);
  for (std::size_t number = 1; number <= b.period.size(); ++number) {
    Curve c{.paint = series_paint(number - 1), .has_line = false, .has_marker = true};
    c.size = 4.0;
    c.along_title = "point";
    c.command = command;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.branch[i] != static_cast<double>(number)) continue;
      c.x.push_back(b.axis.values[i]);
      c.y.push_back(y[i]);
      c.along.push_back(static_cast<double>(i + 1));
      const auto k = static_cast<Eigen::Index>(i);
      std::string text = fmt::format("Point {} of branch {}: {} = {:.8g}, period {:.0f}, {}", i + 1,
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

}  // namespace

std::vector<Figure> branch_figures(const ResultView& result) {
  const Branches b(result);
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
  std::vector<double> multiplier;  // largest of each point
  const CMat all = result.file.complex_matrix("/branch/multiplier");
  for (Eigen::Index i = 0; i < all.rows(); ++i) multiplier.push_back(std::abs(all(i, 0)));

  std::vector<Figure> figures;
  for (const std::size_t s : stations_by_interest(result, stations)) {
    Figure f{.variant = stations[s], .height = contacts.empty() ? 560.0 : 780.0};
    f.subtitle = fmt::format("{}: periodic orbits along {}", stations[s], b.axis.path);
    std::vector<double> radius = column(result, "/branch/max_radius", s);
    const DisplayUnit unit = unit_for(largest_of(radius), "m");
    radius = scaled(std::move(radius), unit.factor);
    Panel p = panel(with_unit("largest distance from the axis", unit));
    p.share = 2.4;
    add_lines(p, b, radius, true);
    add_points(p, result, b, radius, all);
    add_marks(p, b, radius);
    f.panels.push_back(std::move(p));
    Panel m = panel("largest multiplier");
    m.y.first = 0.0;
    m.rules.push_back({Rule::Kind::horizontal, 1.0, "", Paint::ink, Dash::solid});
    add_lines(m, b, multiplier, false);
    f.panels.push_back(std::move(m));
    if (!contacts.empty()) {
      Panel d = panel(contacts.size() > 1 ? contacts[0] + ": share in touch" : "share in touch");
      d.y.first = 0.0;
      add_lines(d, b, column(result, "/branch/duty", 0), false);
      f.panels.push_back(std::move(d));
    }
    f.notes.push_back("Solid: stable, dashed: unstable. Dots are the points that were computed.");
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace whirl
