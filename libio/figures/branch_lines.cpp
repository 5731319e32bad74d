#include "libio/figures/branch_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace whirl::inline io::figures {

namespace {

/// A place between points i and i + 1.
struct Between {
  double x, y;
};
Between place_of(const BranchPoints& b, const std::vector<double>& y, std::size_t i, double x) {
  const double across = b.axis.values[i + 1] - b.axis.values[i];
  const double share = across == 0.0 ? 0.5 : std::clamp((x - b.axis.values[i]) / across, 0.0, 1.0);
  return {x, y[i] + share * (y[i + 1] - y[i])};
}

}  // namespace

BranchPoints::BranchPoints(const ResultView& result)
    : axis(shown_axis(result, "/branch/value")),
      branch(result.file.numbers("/branch/branch")),
      stable(result.file.numbers("/branch/stable")),
      period(result.file.numbers("/branch/period")) {
  // of orbits that are closed seen from the rotor: any number, that of the first point
  if (result.file.has("/branch/revolutions")) {
    const std::vector<double> revolutions = result.file.numbers("/branch/revolutions");
    for (std::size_t i = branch.size(); i-- > 0;) {
      period[static_cast<std::size_t>(branch[i]) - 1] = revolutions[i];
    }
  }
  if (!result.file.has("/branch/bifurcation")) return;
  bifurcation = scaled(result.file.numbers("/branch/bifurcation"), 1.0 / axis.factor);
  kind = result.file.strings("/branch/bifurcation_kind");
  on = result.file.numbers("/branch/bifurcation_branch");
  after = result.file.numbers("/branch/bifurcation_after");
}

std::size_t BranchPoints::before(std::size_t b) const {
  const auto first = std::find(branch.begin(), branch.end(), on[b]) - branch.begin();
  return static_cast<std::size_t>(first) + static_cast<std::size_t>(after[b]) - 1;
}

void BranchPoints::show_as(const ShownAxis& other) {
  const double ratio = axis.factor / other.factor;
  axis.values = scaled(std::move(axis.values), ratio);
  bifurcation = scaled(std::move(bifurcation), ratio);
  axis.title = other.title;
  axis.factor = other.factor;
}

std::vector<double> column_of(const ResultView& result, const std::string& path, std::size_t i) {
  const std::vector<double> all = result.file.numbers(path);
  const auto width = static_cast<std::size_t>(result.file.shape(path).at(1));
  std::vector<double> values;
  for (std::size_t k = i; k < all.size(); k += width) values.push_back(all[k]);
  return values;
}

std::vector<double> largest_multipliers(const ResultView& result) {
  const CMat all = result.file.complex_matrix("/branch/multiplier");
  std::vector<double> largest;
  for (Eigen::Index i = 0; i < all.rows(); ++i) largest.push_back(std::abs(all(i, 0)));
  return largest;
}

void add_branch_lines(Panel& p, const BranchPoints& b, const std::vector<double>& y,
                      const BranchStyle& style) {
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
    return b.stable[b.stable[i] < 0.0 && i + 1 < b.size() ? i + 1 : i] > 0.0;
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
    if (style.is_named)
      c.name = fmt::format("period {:.4g}, {}", period, stays ? "stable" : "unstable");
    c.paint = style.is_ink ? Paint::ink : series_paint(static_cast<std::size_t>(number) - 1);
    c.dash = stays ? Dash::solid : Dash::dashed;
    c.width = stays ? 1.8 : 1.2;
    p.curves.push_back(std::move(c));
  }
}

void add_branch_marks(Panel& p, const BranchPoints& b, const std::vector<double>& y) {
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

}  // namespace whirl::inline io::figures
