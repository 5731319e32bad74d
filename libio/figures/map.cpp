#include "libdyn/studies/map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdyn/studies/basins.hpp"
#include "libio/figures/map_planes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// The command that looks at one cell as the study did.
std::string command_of(const ResultView& result, const Planes& planes, std::size_t plane,
                       const std::string& verb) {
  std::string line = command_on_model(result, verb, {"discard", "tolerance", "from"});
  line += set_command(planes.x.path, "{x}", planes.x.si_unit);
  line += set_command(planes.y.path, "{y}", planes.y.si_unit);
  if (!planes.z.values.empty()) {
    line +=
        set_command(planes.z.path, fmt::format("{:.12g}", planes.z.values[plane] * planes.z.factor),
                    planes.z.si_unit);
  }
  return line;
}

Figure figure_of(const ResultView& result, const Planes& planes, std::size_t plane, Cells cells,
                 const std::string& what) {
  Figure f{.variant = planes.variant(plane), .width = 780.0, .height = 580.0};
  f.subtitle = what + (f.variant.empty() ? "" : ": " + f.variant);
  Panel p;
  p.x.title = planes.x.title;
  p.y.title = planes.y.title;
  p.cells = std::move(cells);
  p.cells.command = command_of(result, planes, plane, "classify");
  p.cells.x_factor = planes.x.factor;
  p.cells.y_factor = planes.y.factor;
  f.panels.push_back(std::move(p));
  return f;
}

/// Keeps the categories that occur, with their shares.
void keep_used(Cells& cells, const std::vector<Category>& all) {
  std::vector<double> counts(all.size(), 0.0), renamed(all.size(), 0.0);
  for (const double v : cells.values) {
    if (std::isfinite(v)) counts[static_cast<std::size_t>(v)] += 1.0;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (counts[i] == 0.0) continue;
    renamed[i] = static_cast<double>(cells.categories.size());
    Category c = all[i];
    c.name +=
        fmt::format(" ({:.3g} %)", 100.0 * counts[i] / static_cast<double>(cells.values.size()));
    cells.categories.push_back(c);
  }
  for (double& v : cells.values) {
    if (std::isfinite(v)) v = renamed[static_cast<std::size_t>(v)];
  }
}

std::vector<Figure> map_figures(const ResultView& result) {
  const Planes planes(shown_axes(result, MapResult::group));
  const auto& points = study_of<MapResult>(result).points;
  std::vector<Figure> figures;
  for (std::size_t plane = 0; plane < planes.count(); ++plane) {
    Cells cells = planes.cells(plane, [&](std::size_t i) {
      const auto point = points[i];
      return point ? motion_number(point->kind, point->period) : std::nan("");
    });
    keep_used(cells, motions());
    cells.title = "motion";
    figures.push_back(figure_of(result, planes, plane, std::move(cells), "Kinds of motion"));
  }
  return figures;
}

std::vector<Figure> exponent_map_figures(const ResultView& result) {
  const Planes planes(shown_axes(result, MapResult::group));
  const auto& points = study_of<MapResult>(result).points;
  std::vector<Figure> figures;
  for (std::size_t plane = 0; plane < planes.count(); ++plane) {
    Cells cells = planes.cells(plane, [&](std::size_t i) {
      const auto point = points[i];
      return point ? point->largest_exponent() : std::nan("");
    });
    cells.map = ColorMap::diverging;
    cells.title = "largest exponent [1/rev]";
    double high = 0.0;
    for (const double v : cells.values) high = std::isfinite(v) ? std::max(high, v) : high;
    cells.last = high > 1e-3 ? high : 0.1;  // white at zero, as far down as up
    cells.first = -cells.last;
    figures.push_back(figure_of(result, planes, plane, std::move(cells),
                                "Largest Lyapunov exponent, chaotic above zero"));
  }
  return figures;
}

std::vector<Figure> regime_map_figures(const ResultView& result) {
  const Planes planes(shown_axes(result, MapResult::group));
  const auto& study = study_of<MapResult>(result);
  const std::vector<std::string>& contacts = study.system.contacts;
  static const std::vector<Category> all{{"no contact", Paint::rest},
                                         {"intermittent", Paint::chaotic},
                                         {"permanent", Paint::period_3}};
  std::vector<Figure> figures;
  for (std::size_t plane = 0; plane < planes.count(); ++plane) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      Cells cells = planes.cells(plane, [&](std::size_t i) {
        const auto point = study.points[i];
        const bool is_known = point && c < point->contacts.size();
        return is_known ? static_cast<double>(point->contacts[c].regime) : std::nan("");
      });
      keep_used(cells, all);
      cells.title = contacts[c];
      Figure f = figure_of(result, planes, plane, std::move(cells), "Contact at " + contacts[c]);
      f.variant = contacts[c] + (f.variant.empty() ? "" : ", " + f.variant);
      figures.push_back(std::move(f));
    }
  }
  return figures;
}

constexpr double not_motions = 2.0;  ///< categories before the motions: not settled, failed

/// Motions that starts lead to, each described by the first start that led there.
/// @param attractor  numbers of categories; one that no start has is without a name
std::vector<Category> basin_categories(const PointRows<BasinsPoint>& points,
                                       const std::vector<double>& attractor) {
  double count = 0.0;
  for (const double a : attractor) count = std::max(count, a - not_motions + 1.0);
  std::vector<Category> all{{"not settled", Paint::not_settled}, {"failed", Paint::failed}};
  for (int number = 1; number <= static_cast<int>(count); ++number) {
    const auto first = static_cast<std::size_t>(
        std::find(attractor.begin(), attractor.end(), number - 1.0 + not_motions) -
        attractor.begin());
    if (first == attractor.size()) {  // of a coarse picture
      all.emplace_back();
      continue;
    }
    const ClassifiedMotion motion = points[first].value_or(BasinsPoint{}).motion;
    const auto kind = static_cast<std::size_t>(motion_number(motion.kind, motion.period));
    all.push_back({fmt::format("{}: {}", number, motions()[kind].name),
                   series_paint(static_cast<std::size_t>(number - 1))});
  }
  return all;
}

/// Displacements at the starts [m, rad], a row per start, x and y at least; NaN where there is
/// none.
Mat starts_of(const PointRows<BasinsPoint>& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Index width = 2;
  for (const auto& p : points) width = std::max(width, p ? p->start.displacement.size() : 0);
  Mat starts = Mat::Constant(count, width, std::nan(""));
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto point = points[static_cast<std::size_t>(i)];
    if (point && point->start.displacement.size() == width)
      starts.row(i) = point->start.displacement;
  }
  return starts;
}

/// The column of x [m] of the place where starts are spread the most; y is in the next one.
Eigen::Index widest_place(const Mat& starts) {
  Eigen::Index widest = 0;
  double spread = -1.0;
  for (Eigen::Index k = 0; k + 1 < starts.cols(); k += 2) {
    double low = INFINITY, high = -INFINITY;
    for (Eigen::Index i = 0; i < starts.rows(); ++i) {
      low = std::min(low, starts(i, k));
      high = std::max(high, starts(i, k));
    }
    const bool is_place = starts.cols() % 4 != 0 || k % 4 == 0;  // not a tilt
    if (is_place && high - low > spread) spread = high - low, widest = k;
  }
  return widest;
}

/// Random starts, by the motion that they lead to.
/// @param step  between the numbers of those that are drawn
Figure starts_figure(const Mat& starts, const std::vector<double>& attractor,
                     const std::vector<Category>& all, std::size_t step) {
  const Eigen::Index widest = widest_place(starts);
  const Mat place = starts.middleCols(widest, 2);  // x, y
  Figure f{.width = 640.0, .height = 600.0};
  f.subtitle = fmt::format("{} random starts and the motions that they lead to", attractor.size());
  Panel p;
  p.has_equal_scales = true;
  double largest = 0.0;
  for (const double v : place.reshaped()) largest = std::max(largest, std::abs(v));
  const DisplayUnit unit = unit_for(largest, "m");
  p.x.title = with_unit("x at the start", unit);
  p.y.title = with_unit("y at the start", unit);
  for (std::size_t a = 0; a < all.size(); ++a) {
    Curve c{.paint = all[a].paint, .has_line = false};
    c.has_marker = true;
    c.marker = static_cast<Marker>(a % markers);
    c.size = 6.0;
    for (std::size_t i = 0; i < attractor.size(); ++i) {
      if (std::max(0.0, attractor[i]) != static_cast<double>(a)) continue;
      const auto row = static_cast<Eigen::Index>(i);
      c.x.push_back(unit.factor * place(row, 0));
      c.y.push_back(unit.factor * place(row, 1));
      c.hover.push_back(fmt::format("start {}, {}", i * step + 1, all[a].name));
    }
    if (c.x.empty()) continue;
    c.name = fmt::format(
        "{} ({:.3g} %)", all[a].name,
        100.0 * static_cast<double>(c.x.size()) / static_cast<double>(attractor.size()));
    p.curves.push_back(std::move(c));
  }
  f.panels.push_back(std::move(p));
  return f;
}

std::vector<Figure> basin_figures(const ResultView& result) {
  const auto& study = study_of<BasinsResult>(result);
  std::vector<double> attractor;  // as categories
  for (const int number : study.attractor) attractor.push_back(number + not_motions);
  const std::vector<Category> all = basin_categories(study.points, attractor);
  std::vector<ShownAxis> axes = shown_axes(result, BasinsResult::group);
  if (axes.size() < 2) {
    const CoarseGrid grid = drawn_grid(result.file, BasinsResult::group);
    return {starts_figure(starts_of(study.points), attractor, all, grid.steps.at(0))};
  }
  const Planes planes(std::move(axes));
  std::vector<Figure> figures;
  for (std::size_t plane = 0; plane < planes.count(); ++plane) {
    Cells cells = planes.cells(plane, [&](std::size_t i) { return std::max(0.0, attractor[i]); });
    keep_used(cells, all);
    figures.push_back(figure_of(result, planes, plane, std::move(cells), "Basins of attraction"));
  }
  return figures;
}

}  // namespace

FigureKind map_kind() {
  return {
      .name = "map",
      .title = "Map",
      .summary = "kinds of motion in a plane of two parameters",
      .needs = {point_dataset<MapResult>("motion")},
      .make = map_figures,
  };
}

FigureKind exponent_map_kind() {
  return {
      .name = "exponent_map",
      .title = "Exponent map",
      .summary = "largest Lyapunov exponent in the plane",
      .needs = {point_dataset<MapResult>("exponent")},
      .make = exponent_map_figures,
  };
}

FigureKind regime_map_kind() {
  return {
      .name = "regime_map",
      .title = "Contact map",
      .summary = "contact in the plane",
      .needs = {point_dataset<MapResult>("regime")},
      .make = regime_map_figures,
  };
}

FigureKind basins_kind() {
  return {
      .name = "basins",
      .title = "Basins",
      .summary = "which motion each start leads to",
      .needs = {dataset_of<BasinsResult>(&BasinsResult::attractor)},
      .make = basin_figures,
  };
}

}  // namespace whirl::inline io
