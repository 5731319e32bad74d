#include <fmt/format.h>

#include <cmath>
#include <set>

#include "libio/figures/map_planes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Shares of the points that have each value of a parameter, by the motion that was found there:
/// areas one upon the other, which fill all of the panel where all is computed.
Figure shares_along(const MapResult& study, const std::vector<ShownAxis>& axes, std::size_t along) {
  const ShownAxis& axis = axes[along];
  const std::size_t values = axis.values.size();
  std::size_t inner = 1;  // points from one value to the next
  for (std::size_t k = along + 1; k < axes.size(); ++k) inner *= axes[k].values.size();
  std::vector<std::vector<double>> counts(motions().size(), std::vector<double>(values, 0.0));
  std::vector<double> all(values, 0.0);
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const auto point = study.points[i];
    if (!point) continue;
    const std::size_t at = i / inner % values;
    counts[static_cast<std::size_t>(motion_number(point->kind, point->period))][at] += 1.0;
    all[at] += 1.0;
  }
  Figure f{.variant = "along " + axis.path, .height = 440.0};
  f.subtitle = fmt::format("Shares of the kinds of motion along {}", axis.path);
  Panel p;
  p.x.title = axis.title;
  p.y = {.title = "share of points [%]", .first = 0.0, .last = 100.0};
  std::vector<double> below(values, 0.0);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (largest_of(counts[k]) == 0.0) continue;
    Curve c{.name = motions()[k].name, .paint = motions()[k].paint, .x = {}};
    c.fill = 0.9;
    c.width = 0.8;
    std::vector<double> under;
    for (std::size_t i = 0; i < values; ++i) {
      if (all[i] == 0.0) continue;
      const double share = 100.0 * counts[k][i] / all[i];
      under.push_back(below[i]);
      below[i] += share;
      c.x.push_back(axis.values[i]);
      c.y.push_back(below[i]);
      c.hover.push_back(fmt::format("{}: {:.3g} %", c.name, share));
    }
    // and back below it
    const std::vector<double> there = c.x;
    c.hover.resize(2 * there.size());
    c.x.insert(c.x.end(), there.rbegin(), there.rend());
    c.y.insert(c.y.end(), under.rbegin(), under.rend());
    p.curves.push_back(std::move(c));
  }
  f.panels.push_back(std::move(p));
  return f;
}

/// How many kinds of motion a point of the plane has over the values of the third parameter.
Figure kinds_of_points(const MapResult& study, const Planes& planes) {
  Figure f{.variant = "kinds over " + planes.z.path, .width = 780.0, .height = 560.0};
  f.subtitle = fmt::format("Number of kinds of motion over {}", planes.z.path);
  Cells cells = planes.cells(0, [&](std::size_t first) {
    std::set<double> kinds;
    for (std::size_t plane = 0; plane < planes.count(); ++plane) {
      const auto point = study.points[first + plane];
      if (!point || !point->kind || *point->kind == MotionKind::not_settled) continue;
      kinds.insert(motion_number(point->kind, point->period));
    }
    return kinds.empty() ? std::nan("") : static_cast<double>(kinds.size());
  });
  cells.title = "kinds of motion";
  cells.first = 0.0;
  cells.last = std::max(1.0, largest_of(cells.values));
  Panel p;
  p.x.title = planes.x.title;
  p.y.title = planes.y.title;
  p.cells = std::move(cells);
  f.panels.push_back(std::move(p));
  f.notes.push_back(
      "Each period up to 8 is a kind of its own, longer ones are one; motions that failed or have "
      "not settled do not count.");
  return f;
}

std::vector<Figure> shares_figures(const ResultView& result) {
  const std::vector<ShownAxis> axes = shown_axes(result, MapResult::group);
  const auto& study = study_of<MapResult>(result);
  std::vector<Figure> figures;
  for (std::size_t along = axes.size(); along-- > 0;) {  // planes first, as their axis is the last
    figures.push_back(shares_along(study, axes, along));
  }
  if (axes.size() > 2) figures.push_back(kinds_of_points(study, Planes(axes)));
  return figures;
}

/// Lines between cells of a plane that a property tells apart.
/// @param side  of a point: which of them it has; nothing: not computed
template <class Side>
Curve edges_of(const Planes& planes, std::size_t plane, const Side& side) {
  Curve c;
  const auto bounds = [](const std::vector<double>& middles) {
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < middles.size(); ++i) {
      all.push_back(0.5 * (middles[i] + middles[i + 1]));
    }
    all.insert(all.begin(), middles.size() > 1 ? 2.0 * middles[0] - all[0] : middles[0]);
    all.push_back(middles.size() > 1 ? 2.0 * middles.back() - all.back() : middles.back());
    return all;
  };
  const std::vector<double> x = bounds(planes.x.values), y = bounds(planes.y.values);
  const auto differ = [&](std::size_t a, std::size_t b) {
    const std::optional<bool> first = side(a), second = side(b);
    return first && second && *first != *second;
  };
  const auto add = [&](double x_from, double y_from, double x_to, double y_to) {
    c.x.insert(c.x.end(), {x_from, x_to, std::nan("")});
    c.y.insert(c.y.end(), {y_from, y_to, std::nan("")});
  };
  for (std::size_t i = 0; i < planes.x.values.size(); ++i) {
    for (std::size_t j = 0; j < planes.y.values.size(); ++j) {
      const std::size_t here = planes.point(i, j, plane);
      if (i + 1 < planes.x.values.size() && differ(here, planes.point(i + 1, j, plane))) {
        add(x[i + 1], y[j], x[i + 1], y[j + 1]);
      }
      if (j + 1 < planes.y.values.size() && differ(here, planes.point(i, j + 1, plane))) {
        add(x[i], y[j + 1], x[i + 1], y[j + 1]);
      }
    }
  }
  return c;
}

/// Where a study has points.
Curve points_of(const Planes& planes) {
  Curve c{.name = "point of the study", .paint = Paint::gray, .has_line = false};
  c.has_marker = true;
  c.size = 4.0;
  for (const double x : planes.x.values) {
    for (const double y : planes.y.values) {
      c.x.push_back(x);
      c.y.push_back(y);
    }
  }
  return c;
}

std::vector<Figure> contact_edge_figures(const ResultView& result) {
  const Planes planes(shown_axes(result, MapResult::group));
  const auto& study = study_of<MapResult>(result);
  const std::vector<std::string>& contacts = study.system.contacts;
  std::vector<Figure> figures;
  for (std::size_t contact = 0; contact < contacts.size(); ++contact) {
    Figure f{.variant = contacts[contact], .width = 780.0, .height = 560.0};
    f.subtitle = fmt::format("{}: edges of contact", contacts[contact]);
    Panel p;
    p.x = {
        .title = planes.x.title, .first = planes.x.values.front(), .last = planes.x.values.back()};
    p.y = {
        .title = planes.y.title, .first = planes.y.values.front(), .last = planes.y.values.back()};
    for (std::size_t plane = 0; plane < planes.count(); ++plane) {
      for (const Regime from : {Regime::none, Regime::permanent}) {
        Curve c = edges_of(planes, plane, [&](std::size_t i) -> std::optional<bool> {
          const auto point = study.points[i];
          if (!point || contact >= point->contacts.size()) return std::nullopt;
          return point->contacts[contact].regime == from;
        });
        if (c.x.empty()) continue;
        c.name = fmt::format("{}{}", from == Regime::none ? "contact" : "permanent contact",
                             planes.z.values.empty() ? "" : ", " + planes.variant(plane));
        c.paint = series_paint(plane);
        c.dash = series_dash(plane);  // of several planes edges may lie on each other
        c.width = from == Regime::permanent ? 2.4 : 1.3;
        p.curves.push_back(std::move(c));
      }
    }
    if (p.curves.empty()) {
      f.notes = {"There is no edge: contact is the same everywhere."};
      p.curves.push_back(points_of(planes));
    }
    f.panels.push_back(std::move(p));
    f.notes.push_back("Edges lie between the points of the study: they are as coarse as it is.");
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind shares_kind() {
  return {
      .name = "shares",
      .title = "Shares",
      .summary = "shares of the kinds of motion along each parameter of a map",
      .needs = {point_dataset<MapResult>("motion")},
      .make = shares_figures,
  };
}

FigureKind contact_edges_kind() {
  return {
      .name = "contact_edges",
      .title = "Edges of contact",
      .summary = "where contact begins and becomes permanent, of all planes of a map in one",
      .needs = {point_dataset<MapResult>("regime")},
      .make = contact_edge_figures,
  };
}

}  // namespace whirl::inline io
