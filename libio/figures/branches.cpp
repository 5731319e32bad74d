#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libio/figures/all.hpp"

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
    f.notes.push_back("Solid: stable, dashed: unstable.");
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace whirl
