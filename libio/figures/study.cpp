#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/drawing/near_range.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/sweep_view.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

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
    Curve c{.name = way_style(ways[w]).name, .paint = way_style(ways[w]).paint, .x = axis.values};
    c.width = 1.2;
    if (w == 1) c.dash = Dash::dashed;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      c.y.push_back(value(w * axis.values.size() + i));
    }
    p.curves.push_back(std::move(c));
  }
}

/// Something that is seen once a revolution: a displacement, a reading.
struct Sections {
  std::string what;
  DisplayUnit unit;
  bool keeps_unit;                                                   ///< that of a probe
  std::function<double(std::size_t point, std::size_t section)> at;  ///< [m]; NaN: there is none
};

/// @param near  motions that leave it are left out
Panel section_panel(const SweepView& v, const Sections& of,
                    const std::optional<Extent>& near = std::nullopt) {
  const std::size_t values = v.axis.values.size();
  Panel p = panel_along(v.axis, with_unit(of.what, of.unit));
  p.share = 2.4;
  for (std::size_t w = 0; w < v.ways.size(); ++w) {
    Curve c{
        .name = way_style(v.ways[w]).name, .paint = way_style(v.ways[w]).paint, .has_line = false};
    c.has_marker = true;
    c.size = w == 0 ? 2.7 : 1.7;  // what is below can be seen around what hides it
    for (std::size_t i = 0; i < values; ++i) {
      const std::size_t point = w * values + i;
      const ClassifiedMotion motion = v.point(point) ? v.point(point)->motion : ClassifiedMotion{};
      const std::string name(motion.kind ? name_of(*motion.kind) : "failed");
      const std::string text =
          motion.period > 0 ? fmt::format("{}, period {}", name, motion.period) : name;
      const auto is_far = [&](std::size_t j) {
        return near && (of.at(point, j) < near->low || of.at(point, j) > near->high);
      };
      bool is_near = true;
      for (std::size_t j = 0; j < v.sections; ++j) is_near = is_near && !is_far(j);
      for (std::size_t j = 0; j < v.sections && is_near; ++j) {
        const double y = of.unit.factor * of.at(point, j);
        if (!std::isfinite(y)) continue;
        c.x.push_back(v.axis.values[i]);
        c.y.push_back(y);
        if (values * v.sections <= 20000) c.hover.push_back(text);
      }
    }
    p.curves.push_back(std::move(c));
  }
  return p;
}

/// How far each motion goes [m].
std::vector<Extent> extents_of(const SweepView& v, const Sections& of) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < v.points.size(); ++i) {
    Extent e{INFINITY, -INFINITY};
    for (std::size_t j = 0; j < v.sections; ++j) {
      const double x = of.at(i, j);
      if (std::isfinite(x)) e.low = std::min(e.low, x), e.high = std::max(e.high, x);
    }
    if (e.low <= e.high) extents.push_back(e);
  }
  return extents;
}

/// Adds the sections; where a few motions are far away, first those that are near each other.
void add_sections(const SweepView& v, const Sections& of, Figure& f) {
  Panel all = section_panel(v, of);
  const std::vector<Extent> extents = extents_of(v, of);
  const auto near = near_range(extents);
  const auto far =
      near
          ? std::count_if(extents.begin(), extents.end(),
                          [&](const Extent& e) { return e.low < near->low || e.high > near->high; })
          : 0;
  if (near && 2 * far < std::ssize(extents)) {
    Sections enlarged = of;
    const double reach = std::max(std::abs(near->low), std::abs(near->high));
    if (!of.keeps_unit) enlarged.unit = unit_for(reach, "m");
    Panel p = section_panel(v, enlarged, near);
    const double factor = enlarged.unit.factor;
    const Axis range = axis_around({factor * near->low, factor * near->high}, Scale::linear);
    p.y.first = range.first, p.y.last = range.last;
    p.title = "without what is far away";
    all.title = "all";
    all.share = 1.2;
    f.notes.push_back(fmt::format(
        "{} of {} motions are far away from the others: the first panel is enlarged, the second "
        "shows all.",
        far, extents.size()));
    f.height += 200.0;
    f.panels.push_back(std::move(p));
  }
  f.panels.push_back(std::move(all));
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
  for (std::size_t i = 0; i < v.points.size(); ++i) {
    all.push_back(v.most(i, &ContactDoing::max_normal));
  }
  const DisplayUnit newton = unit_for(largest_of(all), "N");
  Panel n = panel_along(v.axis, with_unit("largest force", newton));
  n.y.first = 0.0;
  add_lines(n, v.axis, v.ways, [&](std::size_t i) { return newton.factor * all.at(i); });
  return n;
}

/// The same over the force of all unbalances, as if these were at one angle; nothing: there are
/// none, or they are what is varied.
std::optional<Panel> relative_force_panel(const ResultView& result, const SweepView& v) {
  if (!result.model || v.axis.path.starts_with("unbalance.")) return std::nullopt;
  double moment = 0.0;
  for (const Unbalance& u : result.model->structure.unbalances) moment += std::abs(u.moment);
  const bool is_speed = v.axis.path == "operation.speed";
  const std::size_t values = v.axis.values.size();
  Panel p = panel_along(v.axis, "largest force / unbalance");
  p.y.first = 0.0;
  add_lines(p, v.axis, v.ways, [&](std::size_t i) {
    const double Omega = is_speed ? v.axis.factor * v.axis.values[i % values] : result.model->speed;
    return v.most(i, &ContactDoing::max_normal) / (moment * Omega * Omega);
  });
  return moment > 0.0 ? std::optional(std::move(p)) : std::nullopt;
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

/// Largest forces on supports along the values, a panel each; nothing where they are not known.
std::optional<Figure> supports_figure(const ResultView& result, const SweepView& v) {
  constexpr std::size_t most = 6;
  if (!result.file.has(point_dataset<SweepResult>("support_largest"))) return std::nullopt;
  const std::vector<std::string> names =
      result.file.strings(dataset_of<SweepResult>(&SweepResult::supports));
  const auto force = [&](std::size_t i, std::size_t support) {
    const auto at = static_cast<Eigen::Index>(support);
    const Vec& known = v.point(i) ? v.point(i)->portrait.support_largest : Vec();
    return at < known.size() ? known(at) : std::nan("");
  };
  std::vector<std::pair<double, std::size_t>> by_size;
  for (std::size_t k = 0; k < names.size(); ++k) {
    double largest = 0.0;
    for (std::size_t i = 0; i < v.points.size(); ++i) largest = std::fmax(largest, force(i, k));
    by_size.emplace_back(-largest, k);
  }
  std::sort(by_size.begin(), by_size.end());
  Figure f{.variant = "forces on supports"};
  f.subtitle = fmt::format("Largest forces on supports along {}", v.axis.path);
  for (const auto& [size, k] : by_size) {
    if (f.panels.size() == most) break;
    const DisplayUnit newton = unit_for(-size, "N");
    Panel p = panel_along(v.axis, with_unit(names[k], newton));
    p.y.first = 0.0;
    add_lines(p, v.axis, v.ways, [&, k = k](std::size_t i) { return newton.factor * force(i, k); });
    f.panels.push_back(std::move(p));
  }
  if (names.size() > most) {
    f.notes.push_back(fmt::format("The {} of {} supports that carry most.", most, names.size()));
  }
  f.height = 180.0 + 140.0 * static_cast<double>(f.panels.size());
  return f;
}

Panel size_panel(const SweepView& v, std::size_t probe, const DisplayUnit& unit) {
  Panel p = panel_along(v.axis, with_unit("peak to peak", unit));
  p.y.first = 0.0;
  p.share = 1.4;
  add_lines(p, v.axis, v.ways, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(probe);
    const Vec& size = v.point(i) ? v.point(i)->portrait.probe_peak_to_peak : Vec();
    return row < size.size() ? unit.factor * size(row) : std::nan("");
  });
  return p;
}

/// What a probe reads along the values.
Figure along_probe(const ResultView& result, const SweepView& v, std::size_t probe) {
  const ProbeLabel label = v.study.probes[probe];
  const DisplayUnit unit = unit_of(label);
  Figure f{.variant = probe_name(label), .probes = {label.name}};
  f.subtitle = fmt::format("{}: bifurcation diagram along {}", f.variant, v.axis.path);
  add_sections(v,
               {"reading once a revolution", unit, true,
                [&](std::size_t i, std::size_t j) { return v.reading(i, probe, j); }},
               f);
  const double enlarged = 60.0 * static_cast<double>(f.panels.size() - 1);
  if (result.file.has(point_dataset<SweepResult>("probe_peak_to_peak"))) {
    f.panels.push_back(size_panel(v, probe, unit));
  }
  f.panels.push_back(exponent_panel(v));
  if (!v.study.system.contacts.empty()) {
    f.panels.push_back(duty_panel(v));
    f.panels.push_back(force_panel(v));
  }
  f.height = 280.0 + enlarged + 140.0 * static_cast<double>(f.panels.size());
  return f;
}

std::vector<Figure> bifurcation_figures(const ResultView& result) {
  const SweepView v(result);
  const bool has_contacts = !v.study.system.contacts.empty();
  std::vector<Figure> figures;
  for (const std::size_t probe : drawn_probes(result, v.study.probes)) {
    figures.push_back(along_probe(result, v, probe));
  }
  for (const std::size_t s : stations_by_interest(result, v.stations)) {
    Figure f{.variant = v.stations[s], .height = has_contacts ? 820.0 : 560.0};
    f.subtitle = fmt::format("{}: bifurcation diagram along {}", v.stations[s], v.axis.path);
    const DisplayUnit unit = v.unit(s);
    const Sections x{"x once a revolution", unit, false,
                     [&](std::size_t i, std::size_t j) { return v.x(i, s, j); }};
    add_sections(v, x, f);
    f.panels.push_back(exponent_panel(v));
    if (has_contacts) {
      f.panels.push_back(duty_panel(v));
      f.panels.push_back(force_panel(v));
    } else if (result.file.has(point_dataset<SweepResult>("max_radius"))) {
      f.panels.push_back(radius_panel(v, s, unit));
    }
    figures.push_back(std::move(f));
  }
  if (auto supports = supports_figure(result, v)) figures.push_back(std::move(*supports));
  auto force = has_contacts ? relative_force_panel(result, v) : std::nullopt;
  if (!force) return figures;
  Figure f{.variant = "force over unbalance", .height = 560.0};
  f.subtitle =
      fmt::format("Largest contact force over that of the unbalance along {}", v.axis.path);
  f.panels = {std::move(*force), duty_panel(v)};
  figures.push_back(std::move(f));
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

}  // namespace whirl::inline io
