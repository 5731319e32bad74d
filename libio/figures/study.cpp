#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdyn/studies/sweep.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

struct Way {
  const char* name;
  Paint paint;
};

Way way_of(const std::string& direction) {
  if (direction == "down") return {"down", Paint::down};
  if (direction == "fresh") return {"each from the model's start", Paint::up};
  return {"up", Paint::up};
}

Panel panel_along(const ShownAxis& axis, const std::string& title) {
  Panel p;
  p.x = {.title = axis.title, .first = axis.values.front(), .last = axis.values.back()};
  if (!(p.x.first < p.x.last)) p.x.first = p.x.last = not_set;
  p.y.title = title;
  p.cursor = "parameter";
  return p;
}

/// A line through a number per value and way.
void add_lines(Panel& p, const ShownAxis& axis, const std::vector<std::string>& ways,
               const std::function<double(std::size_t)>& value) {
  for (std::size_t w = 0; w < ways.size(); ++w) {
    Curve c{.name = way_of(ways[w]).name, .paint = way_of(ways[w]).paint, .x = axis.values};
    c.width = 1.2;
    if (w == 1) c.dash = Dash::dashed;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      c.y.push_back(value(w * axis.values.size() + i));
    }
    p.curves.push_back(std::move(c));
  }
}

/// A number of a station; NaN where there is none.
double number_of(const Mat& m, std::size_t station, std::size_t i) {
  const auto row = static_cast<Eigen::Index>(station), column = static_cast<Eigen::Index>(i);
  return row < m.rows() && column < m.cols() ? m(row, column) : std::nan("");
}

/// A sweep: its points are way after way, each in the order of the values.
struct SweepView {
  explicit SweepView(const ResultView& result)
      : study(study_of<SweepResult>(result)),
        axis(shown_axes(result, SweepResult::group).at(0)),
        ways(result.file.strings(dataset_of<SweepResult>(&SweepResult::ways))),
        stations(study.stations) {
    for (const auto& p : study.points) {
      if (p) sections = std::max(sections, static_cast<std::size_t>(p->portrait.poincare_x.cols()));
    }
  }
  const SweepResult& study;
  ShownAxis axis;
  std::vector<std::string> ways, stations;
  std::size_t sections = 0;  ///< of a station

  /// Null where it is not computed.
  const SweepPoint* point(std::size_t i) const {
    return i < study.points.size() && study.points[i] ? &*study.points[i] : nullptr;
  }
  /// Displacement once a revolution [m].
  double x(std::size_t i, std::size_t station, std::size_t section) const {
    return point(i) ? number_of(point(i)->portrait.poincare_x, station, section) : std::nan("");
  }
  /// The largest number of all contacts at a point; NaN where nothing is known.
  double most(std::size_t i, double ContactDoing::*number) const {
    double largest = std::nan("");
    if (!point(i)) return largest;
    for (const ContactDoing& c : point(i)->motion.contacts) {
      if (std::isfinite(c.*number)) largest = std::fmax(largest, c.*number);
    }
    return largest;
  }
  /// Unit of the displacements of a station.
  DisplayUnit unit(std::size_t station) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < study.points.size(); ++i) {
      for (std::size_t j = 0; j < sections; ++j) {
        if (std::isfinite(x(i, station, j)))
          largest = std::max(largest, std::abs(x(i, station, j)));
      }
    }
    return unit_for(largest, "m");
  }
};

/// Spectra of a station, one way: order, value, amplitude [m].
struct Spectra {
  std::vector<double> order;
  SweepView of;
  explicit Spectra(const ResultView& result)
      : order(result.file.numbers(dataset_of<SweepResult>(&SweepResult::orders))), of(result) {}
  double at(std::size_t way, std::size_t value, std::size_t station, std::size_t line) const {
    const SweepPoint* point = of.point(way * of.axis.values.size() + value);
    return point ? number_of(point->portrait.spectrum, station, line) : std::nan("");
  }
};

constexpr double shown_orders = 4.0;

/// Displacements once a revolution.
Panel section_panel(const SweepView& v, std::size_t station, const DisplayUnit& unit) {
  const std::size_t values = v.axis.values.size();
  Panel p = panel_along(v.axis, with_unit("x once a revolution", unit));
  p.share = 2.4;
  for (std::size_t w = 0; w < v.ways.size(); ++w) {
    Curve c{.name = way_of(v.ways[w]).name, .paint = way_of(v.ways[w]).paint, .has_line = false};
    c.has_marker = true;
    c.size = w == 0 ? 2.7 : 1.7;  // what is below can be seen around what hides it
    for (std::size_t i = 0; i < values; ++i) {
      const std::size_t point = w * values + i;
      const ClassifiedMotion motion = v.point(point) ? v.point(point)->motion : ClassifiedMotion{};
      const std::string name(motion.kind ? name_of(*motion.kind) : "failed");
      const std::string text =
          motion.period > 0 ? fmt::format("{}, period {}", name, motion.period) : name;
      for (std::size_t j = 0; j < v.sections; ++j) {
        const double x = v.x(point, station, j);
        if (!std::isfinite(x)) continue;
        c.x.push_back(v.axis.values[i]);
        c.y.push_back(unit.factor * x);
        if (values * v.sections <= 20000) c.hover.push_back(text);
      }
    }
    p.curves.push_back(std::move(c));
  }
  return p;
}

Panel exponent_panel(const SweepView& v) {
  Panel e = panel_along(v.axis, "exponent [1/rev]");
  add_lines(e, v.axis, v.ways, [&](std::size_t i) {
    return v.point(i) ? v.point(i)->motion.largest_exponent() : std::nan("");
  });
  // multipliers of strongly attracting orbits are far below: what is near zero tells motions apart
  double low = 0.0;
  for (const Curve& c : e.curves) {
    for (const double y : c.y) low = std::isfinite(y) ? std::min(low, y) : low;
  }
  if (low < -1.5) e.y.first = -1.5;
  e.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  return e;
}

Panel duty_panel(const SweepView& v) {
  Panel d = panel_along(v.axis, "share in touch");
  d.y.first = 0.0;
  add_lines(d, v.axis, v.ways, [&](std::size_t i) { return v.most(i, &ContactDoing::duty); });
  return d;
}

Panel force_panel(const SweepView& v) {
  std::vector<double> all;
  for (std::size_t i = 0; i < v.study.points.size(); ++i) {
    all.push_back(v.most(i, &ContactDoing::max_normal));
  }
  const DisplayUnit newton = unit_for(largest_of(all), "N");
  Panel n = panel_along(v.axis, with_unit("largest force", newton));
  n.y.first = 0.0;
  add_lines(n, v.axis, v.ways, [&](std::size_t i) { return newton.factor * all.at(i); });
  return n;
}

Panel radius_panel(const SweepView& v, std::size_t station, const DisplayUnit& unit) {
  Panel r = panel_along(v.axis, with_unit("largest radius", unit));
  r.y.first = 0.0;
  add_lines(r, v.axis, v.ways, [&](std::size_t i) {
    const auto at = static_cast<Eigen::Index>(station);
    const Vec& radius = v.point(i) ? v.point(i)->portrait.max_radius : Vec();
    return at < radius.size() ? unit.factor * radius(at) : std::nan("");
  });
  return r;
}

std::vector<Figure> bifurcation_figures(const ResultView& result) {
  const SweepView v(result);
  const bool has_contacts = !v.study.system.contacts.empty();
  std::vector<Figure> figures;
  for (const std::size_t s : stations_by_interest(result, v.stations)) {
    Figure f{.variant = v.stations[s], .height = has_contacts ? 820.0 : 560.0};
    f.subtitle = fmt::format("{}: bifurcation diagram along {}", v.stations[s], v.axis.path);
    const DisplayUnit unit = v.unit(s);
    f.panels = {section_panel(v, s, unit), exponent_panel(v)};
    if (has_contacts) {
      f.panels.push_back(duty_panel(v));
      f.panels.push_back(force_panel(v));
    } else if (result.file.has(point_dataset<SweepResult>("max_radius"))) {
      f.panels.push_back(radius_panel(v, s, unit));
    }
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> spectral_map_figures(const ResultView& result) {
  const Spectra s(result);
  std::vector<Figure> figures;
  const auto stations = stations_by_interest(result, s.of.stations);
  constexpr std::size_t most_stations = 3;
  for (std::size_t n = 0; n < std::min(most_stations, stations.size()); ++n) {
    for (std::size_t w = 0; w < (n == 0 ? s.of.ways.size() : 1); ++w) {
      Figure f{.variant = s.of.stations[stations[n]], .width = 820.0, .height = 600.0};
      if (s.of.ways.size() > 1) f.variant += fmt::format(" ({})", s.of.ways[w]);
      f.subtitle = fmt::format("{}: full spectra along {}", f.variant, s.of.axis.path);
      Panel p;
      p.x = {.title = "whirl frequency over speed (backward left)",
             .first = -shown_orders,
             .last = shown_orders};
      p.y.title = s.of.axis.title;
      Cells& c = p.cells;
      c.x = s.order;
      c.y = s.of.axis.values;
      double largest = 0.0;
      for (std::size_t j = 0; j < c.y.size(); ++j) {
        for (std::size_t i = 0; i < c.x.size(); ++i) {
          const double a = s.at(w, j, stations[n], i);
          if (std::isfinite(a)) largest = std::max(largest, a);
          c.values.push_back(a > 0.0 ? std::log10(a) : std::nan(""));
        }
      }
      if (!(largest > 0.0)) continue;
      const DisplayUnit unit = unit_for(largest, "m");
      for (double& v : c.values) v += std::log10(unit.factor);
      c.title = fmt::format("log10 of the radius [{}]", unit.name);
      c.last = std::ceil(std::log10(largest * unit.factor) * 2.0) / 2.0;
      c.first = c.last - 4.0;
      for (const int order : {-3, -2, -1, 0, 1, 2, 3}) {
        p.rules.push_back({Rule::Kind::vertical, static_cast<double>(order), "",
                           order == 0 ? Paint::ink : Paint::gray, Dash::dotted});
      }
      f.panels.push_back(std::move(p));
      figures.push_back(std::move(f));
    }
  }
  return figures;
}

std::vector<Figure> cascade_figures(const ResultView& result) {
  const Spectra s(result);
  std::vector<Figure> figures;
  constexpr std::size_t most_lines = 40;
  const std::size_t values = s.of.axis.values.size();
  const std::size_t every = (values + most_lines - 1) / most_lines;
  const std::size_t station = stations_by_interest(result, s.of.stations).front();
  for (std::size_t w = 0; w < s.of.ways.size(); ++w) {
    Figure f{.variant = s.of.stations[station], .width = 760.0, .height = 680.0};
    if (s.of.ways.size() > 1) f.variant += fmt::format(" ({})", s.of.ways[w]);
    f.subtitle = fmt::format("{}: cascade along {}", f.variant, s.of.axis.path);
    Panel p;
    p.x = {.title = "whirl frequency over speed (backward left)",
           .first = -shown_orders,
           .last = shown_orders};
    p.y.title = s.of.axis.title;
    double largest = 0.0;
    for (std::size_t j = 0; j < values; ++j) {
      for (std::size_t i = 0; i < s.order.size(); ++i) {
        const double a = s.at(w, j, station, i);
        if (std::isfinite(a)) largest = std::max(largest, a);
      }
    }
    if (!(largest > 0.0)) continue;
    const double range = s.of.axis.values.back() - s.of.axis.values.front();
    constexpr double powers = 3.0;  // of ten, below the largest: 1X would hide all else
    const double height = (range > 0.0 ? range : 1.0) * 0.09;
    const DisplayUnit unit = unit_for(largest, "m");
    std::size_t number = 0;
    for (std::size_t j = 0; j < values; j += every) {
      Curve c{.paint = number++ % 2 == 0 ? Paint::forward : Paint::ink};
      c.width = 0.9;
      for (std::size_t i = 0; i < s.order.size(); ++i) {
        if (std::abs(s.order[i]) > shown_orders + 0.05) continue;
        const double a = s.at(w, j, station, i);
        c.x.push_back(s.order[i]);
        const double rise = a > 0.0 ? std::max(0.0, 1.0 + std::log10(a / largest) / powers) : 0.0;
        c.y.push_back(s.of.axis.values[j] + height * rise);
      }
      p.curves.push_back(std::move(c));
    }
    for (const int order : {-1, 0, 1}) {
      p.rules.push_back({Rule::Kind::vertical, static_cast<double>(order), "",
                         order == 0 ? Paint::ink : Paint::gray, Dash::dotted});
    }
    f.panels.push_back(std::move(p));
    f.notes = {
        fmt::format("Heights are logarithmic: from {:.3g} {}, the largest radius, down to a "
                    "thousandth of it.",
                    unit.factor * largest, unit.name)};
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind bifurcation_kind() {
  return {
      .name = "bifurcation",
      .title = "Bifurcation",
      .summary = "bifurcation diagram, with exponents, time in touch and forces",
      .needs = {point_dataset<SweepResult>("poincare_x")},
      .make = bifurcation_figures,
  };
}

FigureKind spectral_map_kind() {
  return {
      .name = "spectral_map",
      .title = "Spectral map",
      .summary = "spectra along a parameter, as colors",
      .needs = {point_dataset<SweepResult>("spectrum")},
      .make = spectral_map_figures,
  };
}

FigureKind cascade_kind() {
  return {
      .name = "cascade",
      .title = "Cascade",
      .summary = "spectra along a parameter, one above the other",
      .needs = {point_dataset<SweepResult>("spectrum")},
      .make = cascade_figures,
  };
}

}  // namespace whirl::inline io
