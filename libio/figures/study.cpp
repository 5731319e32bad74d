#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/common.hpp"
#include "libio/results/motion_codes.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// A dataset of a study as (point of the plane, rest), points in the order of the file.
struct Table {
  Table(const ResultView& result, const std::string& path, std::size_t axes)
      : values(result.file.numbers(path)), shape(result.file.shape(path)) {
    for (std::size_t i = axes; i < shape.size(); ++i) {
      width *= static_cast<std::size_t>(shape[i]);
    }
  }
  std::vector<double> values;
  std::vector<Eigen::Index> shape;
  std::size_t width = 1;  ///< numbers of a point

  double at(std::size_t point, std::size_t i = 0) const { return values[point * width + i]; }
  /// The largest number of a point.
  double most(std::size_t point) const {
    double largest = std::nan("");
    for (std::size_t i = 0; i < width; ++i) {
      if (std::isfinite(at(point, i))) largest = std::fmax(largest, at(point, i));
    }
    return largest;
  }
};

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

/// Spectra of a station, one way: order, value, amplitude [m].
struct Spectra {
  std::vector<double> order;
  ShownAxis axis;
  std::vector<std::string> stations, ways;
  Table amplitude;
  explicit Spectra(const ResultView& result)
      : order(numbers(result.file.vector("/sweep/order"))),
        axis(shown_axis(result, "/sweep/axis_1")),
        stations(result.file.strings("/sweep/station")),
        ways(result.file.strings("/sweep/direction")),
        amplitude(result, "/sweep/spectrum", 2) {}
  double at(std::size_t way, std::size_t value, std::size_t station, std::size_t line) const {
    return amplitude.at(way * axis.values.size() + value, station * order.size() + line);
  }
};

constexpr double shown_orders = 4.0;

/// What the panels of a bifurcation diagram are made of.
struct SweepView {
  explicit SweepView(const ResultView& r)
      : result(r),
        axis(shown_axis(r, "/sweep/axis_1")),
        ways(r.file.strings("/sweep/direction")),
        stations(r.file.strings("/sweep/station")),
        x(r, "/sweep/poincare_x", 2),
        sections(x.width / stations.size()) {}

  const ResultView& result;
  ShownAxis axis;
  std::vector<std::string> ways, stations;
  Table x;               ///< once a revolution [m]
  std::size_t sections;  ///< of a station

  /// Unit of the displacements of a station.
  DisplayUnit unit(std::size_t station) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < ways.size() * axis.values.size(); ++i) {
      for (std::size_t j = 0; j < sections; ++j) {
        const double v = x.at(i, station * sections + j);
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
      }
    }
    return unit_for(largest, "m");
  }
};

/// Displacements once a revolution.
Panel section_panel(const SweepView& v, std::size_t station, const DisplayUnit& unit) {
  const Table motion(v.result, "/sweep/motion", 2), period(v.result, "/sweep/period", 2);
  const MotionCodes codes(v.result.file, "/sweep/motion");
  const std::size_t values = v.axis.values.size();
  Panel p = panel_along(v.axis, with_unit("x once a revolution", unit));
  p.share = 2.4;
  for (std::size_t w = 0; w < v.ways.size(); ++w) {
    Curve c{.name = way_of(v.ways[w]).name, .paint = way_of(v.ways[w]).paint, .has_line = false};
    c.has_marker = true;
    c.size = w == 0 ? 2.7 : 1.7;  // what is below can be seen around what hides it
    for (std::size_t i = 0; i < values; ++i) {
      const std::size_t point = w * values + i;
      const auto kind = codes.kind(motion.at(point));
      const std::string name(kind ? name_of(*kind) : "failed");
      const std::string text =
          period.at(point) > 0.0 ? fmt::format("{}, period {:.0f}", name, period.at(point)) : name;
      for (std::size_t j = 0; j < v.sections; ++j) {
        const double x = v.x.at(point, station * v.sections + j);
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
  const Table exponent(v.result, "/sweep/exponent", 2);
  Panel e = panel_along(v.axis, "exponent [1/rev]");
  add_lines(e, v.axis, v.ways, [&](std::size_t i) { return exponent.at(i); });
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
  const Table duty(v.result, "/sweep/duty", 2);
  Panel d = panel_along(v.axis, "share in touch");
  d.y.first = 0.0;
  add_lines(d, v.axis, v.ways, [&](std::size_t i) { return duty.most(i); });
  return d;
}

Panel force_panel(const SweepView& v) {
  const Table force(v.result, "/sweep/max_normal", 2);
  const DisplayUnit newton = unit_for(largest_of(force.values), "N");
  Panel n = panel_along(v.axis, with_unit("largest force", newton));
  n.y.first = 0.0;
  add_lines(n, v.axis, v.ways, [&](std::size_t i) { return newton.factor * force.most(i); });
  return n;
}

Panel radius_panel(const SweepView& v, std::size_t station, const DisplayUnit& unit) {
  const Table radius(v.result, "/sweep/max_radius", 2);
  Panel r = panel_along(v.axis, with_unit("largest radius", unit));
  r.y.first = 0.0;
  add_lines(r, v.axis, v.ways, [&](std::size_t i) { return unit.factor * radius.at(i, station); });
  return r;
}

std::vector<Figure> bifurcation_figures(const ResultView& result) {
  const SweepView v(result);
  const bool has_contacts = result.file.has("/sweep/duty");
  std::vector<Figure> figures;
  for (const std::size_t s : stations_by_interest(result, v.stations)) {
    Figure f{.variant = v.stations[s], .height = has_contacts ? 820.0 : 560.0};
    f.subtitle = fmt::format("{}: bifurcation diagram along {}", v.stations[s], v.axis.path);
    const DisplayUnit unit = v.unit(s);
    f.panels = {section_panel(v, s, unit), exponent_panel(v)};
    if (has_contacts) {
      f.panels.push_back(duty_panel(v));
      f.panels.push_back(force_panel(v));
    } else if (result.file.has("/sweep/max_radius")) {
      f.panels.push_back(radius_panel(v, s, unit));
    }
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> spectral_map_figures(const ResultView& result) {
  const Spectra s(result);
  std::vector<Figure> figures;
  const auto stations = stations_by_interest(result, s.stations);
  constexpr std::size_t most_stations = 3;
  for (std::size_t n = 0; n < std::min(most_stations, stations.size()); ++n) {
    for (std::size_t w = 0; w < (n == 0 ? s.ways.size() : 1); ++w) {
      Figure f{.variant = s.stations[stations[n]], .width = 820.0, .height = 600.0};
      if (s.ways.size() > 1) f.variant += fmt::format(" ({})", s.ways[w]);
      f.subtitle = fmt::format("{}: full spectra along {}", f.variant, s.axis.path);
      Panel p;
      p.x = {.title = "whirl frequency over speed (backward left)",
             .first = -shown_orders,
             .last = shown_orders};
      p.y.title = s.axis.title;
      Cells& c = p.cells;
      c.x = s.order;
      c.y = s.axis.values;
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
  const std::size_t values = s.axis.values.size();
  const std::size_t every = (values + most_lines - 1) / most_lines;
  const std::size_t station = stations_by_interest(result, s.stations).front();
  for (std::size_t w = 0; w < s.ways.size(); ++w) {
    Figure f{.variant = s.stations[station], .width = 760.0, .height = 680.0};
    if (s.ways.size() > 1) f.variant += fmt::format(" ({})", s.ways[w]);
    f.subtitle = fmt::format("{}: cascade along {}", f.variant, s.axis.path);
    Panel p;
    p.x = {.title = "whirl frequency over speed (backward left)",
           .first = -shown_orders,
           .last = shown_orders};
    p.y.title = s.axis.title;
    double largest = 0.0;
    for (std::size_t j = 0; j < values; ++j) {
      for (std::size_t i = 0; i < s.order.size(); ++i) {
        const double a = s.at(w, j, station, i);
        if (std::isfinite(a)) largest = std::max(largest, a);
      }
    }
    if (!(largest > 0.0)) continue;
    const double range = s.axis.values.back() - s.axis.values.front();
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
        c.y.push_back(s.axis.values[j] + height * rise);
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
      .needs = {"/sweep/poincare_x"},
      .make = bifurcation_figures,
  };
}

FigureKind spectral_map_kind() {
  return {
      .name = "spectral_map",
      .title = "Spectral map",
      .summary = "spectra along a parameter, as colors",
      .needs = {"/sweep/spectrum"},
      .make = spectral_map_figures,
  };
}

FigureKind cascade_kind() {
  return {
      .name = "cascade",
      .title = "Cascade",
      .summary = "spectra along a parameter, one above the other",
      .needs = {"/sweep/spectrum"},
      .make = cascade_figures,
  };
}

}  // namespace whirl::inline io
