#include "libio/figures/branch_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libio/figures/result_of.hpp"

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
    : of(result_of<BranchResult>(result)),
      axis(shown_axis(result, dataset_of<BranchResult>(&BranchOrbit::value))) {
  for (const BranchRow& b : of.branches) period.push_back(b.period);
  // of orbits that are closed seen from the rotor: any number, that of the first point
  if (!result.file.has(dataset_of<BranchResult>(&BranchOrbit::revolutions))) return;
  for (std::size_t i = size(); i-- > 0;) {
    period.at(static_cast<std::size_t>(of.points[i].branch) - 1) = of.points[i].revolutions;
  }
}

std::size_t BranchPoints::before(const BranchBifurcation& b) const {
  const auto first = std::find_if(of.points.begin(), of.points.end(),
                                  [&](const BranchOrbit& p) { return p.branch == b.branch; });
  return static_cast<std::size_t>(first - of.points.begin()) + static_cast<std::size_t>(b.after);
}

void BranchPoints::show_as(const ShownAxis& other) {
  axis.values = scaled(std::move(axis.values), axis.factor / other.factor);
  axis.title = other.title;
  axis.factor = other.factor;
}

std::vector<double> BranchPoints::numbers(
    const std::function<double(const BranchOrbit&)>& number) const {
  std::vector<double> values;
  for (const BranchOrbit& p : of.points) values.push_back(number(p));
  return values;
}

std::vector<double> BranchPoints::numbers(std::vector<double> BranchOrbit::*list,
                                          std::size_t i) const {
  return numbers(
      [&](const BranchOrbit& p) { return i < (p.*list).size() ? (p.*list)[i] : std::nan(""); });
}

double largest_multiplier(const BranchOrbit& point) {
  return point.multipliers.size() > 0 ? std::abs(point.multipliers(0)) : std::nan("");
}

void add_branch_lines(Panel& p, const BranchPoints& b, const std::vector<double>& y,
                      const BranchStyle& style) {
  const std::vector<BranchOrbit>& points = b.of.points;
  std::map<std::pair<int, bool>, Curve> lines;
  const auto draw = [&](int branch, bool is_stable, Between from, Between to) {
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
    const bool is_next = points[i].stability < 0 && i + 1 < b.size();
    return points[is_next ? i + 1 : i].stability > 0;
  };
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    const int branch = points[i].branch;
    if (branch != points[i + 1].branch) continue;
    const Between from{b.axis.values[i], y[i]}, to{b.axis.values[i + 1], y[i + 1]};
    if (is_stable(i) == is_stable(i + 1)) {
      draw(branch, is_stable(i), from, to);
      continue;
    }
    Between change = place_of(b, y, i, 0.5 * (from.x + to.x));
    for (const BranchBifurcation& at : b.of.bifurcations) {
      if (b.before(at) != i || at.kind == BifurcationKind::grazing) continue;
      change = place_of(b, y, i, b.place(at));
    }
    draw(branch, is_stable(i), from, change);
    draw(branch, is_stable(i + 1), change, to);
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
    BifurcationKind kind;
    Marker marker;
    Paint paint;
    double size;
  };
  using enum BifurcationKind;
  for (const Style& style : {Style{fold, Marker::square, Paint::ink, 8.0},
                             Style{period_doubling, Marker::diamond, Paint::alarm, 9.0},
                             Style{neimark_sacker, Marker::circle, Paint::quasi_periodic, 9.0},
                             Style{pitchfork, Marker::triangle, Paint::mixed, 9.0},
                             Style{grazing, Marker::cross, Paint::gray, 6.0}}) {
    const std::string name(name_of(style.kind));
    Curve c{.name = name, .paint = style.paint, .has_line = false, .has_marker = true};
    c.marker = style.marker;
    c.size = style.size;
    for (const BranchBifurcation& found : b.of.bifurcations) {
      const std::size_t i = b.before(found);
      if (found.kind != style.kind || i + 1 >= b.size()) continue;
      const Between at = place_of(b, y, i, b.place(found));
      c.x.push_back(at.x);
      c.y.push_back(at.y);
      c.hover.push_back(fmt::format("{} at {:.7g}", name, b.place(found)));
    }
    if (!c.x.empty()) p.curves.push_back(std::move(c));
  }
}

}  // namespace whirl::inline io::figures
