#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libdyn/system/stations.hpp"
#include "libio/drawing/disk_shape.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/front_view.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

using namespace figures;

namespace {

constexpr double of_parts = 0.55, of_layers = 0.9;  ///< how dense areas are painted

Curve area(const std::string& name, Paint paint, std::vector<double> x, std::vector<double> y,
           const std::string& hover) {
  Curve c{.name = name, .paint = paint};
  c.x = std::move(x);
  c.y = std::move(y);
  c.width = 1.0;
  c.fill = of_parts;
  c.hover.assign(c.x.size(), hover);
  return c;
}

/// Both halves of a ring of a section, seen from the side [shown unit of mm].
void add_body(Panel& p, const std::string& name, Paint paint, double from, double to, Section left,
              Section right, const std::string& hover) {
  if (left.inner <= 0.0 && right.inner <= 0.0) {
    p.curves.push_back(area(name, paint, {from, to, to, from, from},
                            {0.5 * left.outer, 0.5 * right.outer, -0.5 * right.outer,
                             -0.5 * left.outer, 0.5 * left.outer},
                            hover));
    return;
  }
  for (const double side : {1.0, -1.0}) {
    p.curves.push_back(
        area(name, paint, {from, to, to, from, from},
             {side * 0.5 * left.outer, side * 0.5 * right.outer, side * 0.5 * right.inner,
              side * 0.5 * left.inner, side * 0.5 * left.outer},
             hover));
  }
}

/// A name above the rotor at a position.
struct Name {
  double z = 0.0, height = 0.0;
  std::string text;
  Paint paint = Paint::ink;
  bool is_below = false;
};

/// Names in rows, so that those side by side do not lie on each other.
void add_names(Panel& p, std::vector<Name> names, double length, double top, double pitch) {
  std::stable_sort(names.begin(), names.end(),
                   [](const Name& a, const Name& b) { return a.z < b.z; });
  for (const bool is_below : {false, true}) {
    std::vector<double> ends;  // of the rows so far
    for (const Name& n : names) {
      if (n.is_below != is_below) continue;
      const double half = 0.5 * text_width(n.text, 11.5) / 600.0 * length;
      std::size_t line = 0;
      while (line < ends.size() && ends[line] > n.z - half) ++line;
      if (line == ends.size()) ends.push_back(0.0);
      ends[line] = n.z + half;
      const double side = is_below ? -1.0 : 1.0;
      const double y = side * (top + pitch * (0.9 + static_cast<double>(line)));
      Curve leader{.paint = n.paint};
      leader.width = 0.7;
      leader.dash = Dash::dotted;
      leader.x = {n.z, n.z};
      leader.y = {side * n.height, y - side * 0.35 * pitch};
      p.curves.push_back(leader);
      p.labels.push_back({n.z, y, n.text, Anchor::middle, 0.0, 4.0, n.paint});
    }
  }
}

std::string stiffness_text(const Connection& b) {
  if (b.is_rigid || b.is_clamped) return "rigid";
  const BearingCoefficients c = coefficients(b.coefficients, 0.0);
  return fmt::format("{}, {}", format_engineering(c.K(0, 0), "N/m"),
                     format_engineering(c.C(0, 0), "N.s/m"));
}

/// A rotor seen from the side, while its parts are added to the panel [shown unit of mm].
struct SideView {
  const Model& model;
  const Assembler& assembler;
  double length = 0.0;  ///< of all shafts
  Panel panel{};
  std::vector<Name> names{};
  double top = 0.0;  ///< largest radius so far

  double symbol() const { return 0.022 * length; }  ///< size of a bearing's triangle
  /// Along the shaft; below zero if a station is not on it.
  double position(const Station& station) const {
    const auto z = assembler.mesh().position_of(assembler.point(station));
    return z ? per_mm() * *z : -1.0;
  }
  /// Of the shaft at a station on it.
  double shaft_radius(const Station& station) const {
    const Point p = assembler.point(station);
    if (p.kind != Point::Kind::node) return 0.0;
    return 0.5 * per_mm() * diameter_at(model.structure, assembler.mesh(), p.index);
  }
  /// A piece of the shaft, or a layer on it [shown unit of mm].
  /// @param fill  how dense it is painted
  void add_part(const std::string& kind, const std::string& name, const auto& part, double from,
                double to, double fill) {
    const std::size_t before = panel.curves.size();
    const auto shown = [](const Section& c) {
      return Section{per_mm() * c.outer, per_mm() * c.inner};
    };
    const double left = per_mm() * part.left.outer, right = per_mm() * part.right.outer;
    add_body(
        panel, kind, Paint::shaft, from, to, shown(part.left), shown(part.right),
        fmt::format("{0}: {1:g} to {2:g} {5}, diameter {3:g}{4} {5}", name, from, to, left,
                    right == left ? "" : fmt::format(" to {:g}", right), shown_unit("mm").name));
    for (std::size_t i = before; i < panel.curves.size(); ++i) panel.curves[i].fill = fill;
    top = std::max({top, 0.5 * left, 0.5 * right});
  }
  /// A part whose name stands beyond its outermost radius.
  void add_name(double at, double radius, const std::string& name, Paint paint, bool is_below) {
    names.push_back({at, radius, name, paint, is_below});
    top = std::max(top, radius);
  }
};

void add_shaft(SideView& v) {
  const Structure& s = v.model.structure;
  for (const Structure::Shaft& shaft : s.shafts()) {
    double z = per_mm() * shaft.start;
    for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
      const Segment& segment = shaft.segments[i];
      const double to = z + per_mm() * segment.length;
      const std::string of = shaft.name.empty() ? "" : " of " + shaft.name;
      v.add_part(shaft.name.empty() ? "shaft" : "shaft " + shaft.name,
                 fmt::format("section {}{}", i + 1, of), segment, z, to,
                 shaft.name.empty() ? of_parts : of_layers);
      z = to;
    }
  }
  for (const Layer& layer : s.layers) {
    const LayerSpan span = span_of(layer, s, v.assembler.mesh());
    v.add_part("layer", layer.name, layer, per_mm() * span.from, per_mm() * span.to, of_layers);
  }
}

/// A disk whose size is not given, as a broken line above and below the shaft.
void add_symbol(Panel& p, const DiskShape& shape, double at, Section section,
                const std::string& hover) {
  for (const double side : {0.5, -0.5}) {
    Curve c{.name = legend_name(shape), .paint = Paint::disk};
    c.x = {at, at};
    c.y = {side * section.inner, side * section.outer};
    c.width = 2.4;
    c.hover.assign(2, hover);
    p.curves.push_back(std::move(c));
  }
}

void add_disks(SideView& v) {
  const Structure& s = v.model.structure;
  for (const Disk& d : s.disks) {
    const DiskShape shape = disk_shape(d, v.model, v.assembler);
    const double at = v.position(d.at), half = 0.5 * per_mm() * shape.width;
    const double outer = 2.0 * per_mm() * shape.outer_radius;
    const double inner = 2.0 * v.shaft_radius(d.at);
    const std::string hover =
        fmt::format("{}: {:.4g} kg, Ip {:.4g}, Id {:.4g} kg.m²{}", d.name, d.m, d.Ip, d.Id,
                    shape.not_given.empty() ? "" : fmt::format(", {} not given", shape.not_given));
    const std::size_t before = v.panel.curves.size();
    if (shape.not_given == "size") {
      add_symbol(v.panel, shape, at, {outer, inner}, hover);
    } else {
      add_body(v.panel, legend_name(shape), Paint::disk, at - half, at + half, {outer, inner},
               {outer, inner}, hover);
    }
    for (std::size_t i = before; i < v.panel.curves.size() && !shape.not_given.empty(); ++i) {
      v.panel.curves[i].dash = Dash::dashed;
      v.panel.curves[i].fill = 0.0;
    }
    v.add_name(at, 0.5 * outer, d.name, Paint::disk, false);
  }
}

/// Two rectangles above and below the shaft, from a radius on.
void add_ring(SideView& v, const char* name, Paint paint, double at, double half_length, double low,
              double height, const std::string& hover) {
  const double high = low + height, left = at - half_length, right = at + half_length;
  for (const double side : {1.0, -1.0}) {
    v.panel.curves.push_back(area(name, paint, {left, right, right, left, left},
                                  {side * low, side * low, side * high, side * high, side * low},
                                  hover));
  }
}

/// What carries the shaft at a station, as triangles above and below.
void add_support(SideView& v, const char* kind, const std::string& name, const Station& station,
                 const std::string& what) {
  const double symbol = v.symbol(), at = v.position(station), radius = v.shaft_radius(station);
  if (at < 0.0) return;
  for (const double side : {1.0, -1.0}) {
    v.panel.curves.push_back(
        area(kind, Paint::bearing, {at, at + 0.6 * symbol, at - 0.6 * symbol, at},
             {side * radius, side * (radius + symbol), side * (radius + symbol), side * radius},
             fmt::format("{} {}: {}", kind, name, what)));
  }
  v.add_name(at, radius + symbol, name, Paint::bearing, true);
}

void add_bearings(SideView& v) {
  const Structure& s = v.model.structure;
  for (const Connection& b : s.bearings) {
    add_support(v, "bearing", b.name, b.from, stiffness_text(b));
  }
  for (const Support& support : s.supports) {
    const bool is_magnetic = support.sensors > 0;
    for (const Station* at : places_of(support)) {
      const bool acts = std::ranges::any_of(
          support.acts_on, [&](const InterfaceCoordinate& c) { return c.at == *at; });
      if (!acts) continue;  // a sensor
      add_support(v, is_magnetic ? "magnetic bearing" : "support", support.name, *at,
                  fmt::format("{} states", support.law.states()));
    }
  }
}

/// Gears out to their pitch circles. The model does not give their width.
void add_gears(SideView& v) {
  const double half = 0.5 * v.symbol();
  for (const GearPair& g : v.model.structure.gears) {
    double top = 0.0, named = -1.0;
    for (const auto& [station, r] :
         {std::pair(&g.driving, g.driving_radius), std::pair(&g.driven, g.driven_radius)}) {
      const double at = v.position(*station), inner = v.shaft_radius(*station);
      if (at < 0.0) continue;
      const double height = std::max(per_mm() * r - inner, 0.1 * per_mm() * r);
      add_ring(v, "gear", Paint::disk, at, half, inner, height,
               fmt::format("gear {}: pitch radius {}", g.name, format_length(r)));
      if (inner + height > top) top = inner + height, named = at;
    }
    if (named >= 0.0) v.add_name(named, top, g.name, Paint::disk, false);
  }
}

/// Seals as rings with teeth towards the shaft.
void add_seals(SideView& v) {
  const double symbol = v.symbol(), gap = 0.004 * v.length;
  for (const Connection& s : v.model.structure.seals) {
    const double at = v.position(s.from);
    if (at < 0.0) continue;
    const double tip = v.shaft_radius(s.from) + gap, top = tip + 0.7 * symbol;
    for (const double side : {1.0, -1.0}) {
      const SealShape shape = seal_shape(at, 0.8 * symbol, side * tip, side * top);
      v.panel.curves.push_back(area("seal", Paint::seal, shape.x, shape.y,
                                    fmt::format("seal {}: {}", s.name, stiffness_text(s))));
    }
    v.add_name(at, top, s.name, Paint::seal, true);
  }
}

/// Rolling bearings. The model does not give their width.
void add_rolling_bearings(SideView& v) {
  for (const Contact& b : rolling_bearings(v.model.contacts)) {
    const double at = v.position(b.at);
    if (at < 0.0) continue;
    const double low = v.shaft_radius(b.at) + 0.004 * v.length;
    add_ring(v, "rolling bearing", Paint::bearing, at, 0.3 * v.symbol(), low, 0.5 * v.symbol(),
             fmt::format("rolling bearing {}: {} elements", b.name, places_of(b.geometry)));
    v.add_name(at, low + 0.5 * v.symbol(), b.name, Paint::bearing, true);
  }
}

/// Bearings of oil films, as long as they are.
void add_films(SideView& v) {
  for (const OilFilm& f : v.model.films) {
    const double at = v.position(f.at);
    if (at < 0.0) continue;
    const double low = std::max(per_mm() * f.bearing.radius, v.shaft_radius(f.at)) +
                       std::max(per_mm() * f.bearing.clearance, 0.004 * v.length);
    add_ring(v, "oil film", Paint::bearing, at, 0.5 * per_mm() * f.bearing.length, low,
             0.5 * v.symbol(),
             fmt::format("oil film {}: clearance {}", f.name, format_length(f.bearing.clearance)));
    v.add_name(at, low + 0.5 * v.symbol(), f.name, Paint::bearing, true);
  }
}

void add_contacts(SideView& v) {
  const double symbol = v.symbol();
  for (const Contact& c : stator_contacts(v.model.contacts)) {
    const double at = v.position(c.at);
    if (at < 0.0) continue;
    const double radius =
        c.friction.radius > 0.0 ? per_mm() * c.friction.radius : v.shaft_radius(c.at);
    const double low = radius + std::max(per_mm() * c.clearance, 0.004 * v.length);
    add_ring(v, "contact", Paint::stator, at, 0.8 * symbol, low, 0.5 * symbol,
             fmt::format("contact {}: clearance {}", c.name, format_length(c.clearance)));
    v.add_name(at, low + 0.5 * symbol, c.name, Paint::stator, true);
  }
}

/// Probes as bars that look at the shaft, from above or from below, or along it at a face.
void add_probe_bars(SideView& v) {
  const double symbol = v.symbol(), gap = 0.004 * v.length;
  for (const Probe& probe : v.model.structure.probes) {
    const double at = v.position(probe.at);
    if (at < 0.0) continue;
    const double near = v.shaft_radius(probe.at) + gap, far = near + 1.4 * symbol;
    const bool is_below = std::sin(probe.angle) < 0.0;
    const double side = is_below ? -1.0 : 1.0;
    Curve bar{.name = "probe", .paint = Paint::stator};
    bar.width = 3.0;
    bar.x = {at, at};
    bar.y = {side * near, side * far};
    if (probe.is_axial()) {
      bar.x = {at + gap, at + gap + 1.4 * symbol};
      bar.y.assign(2, side * per_mm() * probe.face_radius);
    }
    const double top = std::abs(bar.y.back());
    bar.hover.assign(2, "probe " + probe_name(probe));
    v.panel.curves.push_back(std::move(bar));
    v.add_name(at, top, probe.name, Paint::stator, is_below);
  }
}

/// The axis of the shaft, and the nodes on it.
void add_nodes(SideView& v) {
  const auto& z = v.assembler.mesh().z;
  Curve nodes{.name = "node", .paint = Paint::ink, .has_line = false};
  nodes.has_marker = true;
  nodes.size = 3.2;
  std::vector<std::string> what(z.size());
  for (const NamedPoint& n : named_points(v.model, v.assembler)) {
    if (n.node() > 0) what[static_cast<std::size_t>(n.node() - 1)] = n.name;
  }
  for (std::size_t i = 0; i < z.size(); ++i) {
    nodes.x.push_back(per_mm() * z[i]);
    nodes.y.push_back(0.0);
    nodes.hover.push_back(fmt::format("node {}{}{}", i + 1, what[i].empty() ? "" : ": ", what[i]));
  }
  Curve axis{.paint = Paint::gray};
  axis.width = 0.8;
  axis.dash = Dash::dash_dot;
  axis.x = {-0.03 * v.length, 1.03 * v.length};
  axis.y = {0.0, 0.0};
  v.panel.curves.push_back(axis);
  v.panel.curves.push_back(nodes);
}

std::vector<Figure> layout_of(const Model& model, const Assembler& assembler) {
  SideView v{model, assembler, per_mm() * model.structure.extent()};
  if (!(v.length > 0.0)) return front_view(model);
  add_shaft(v);
  add_disks(v);
  add_gears(v);
  add_bearings(v);
  add_seals(v);
  add_films(v);
  add_rolling_bearings(v);
  add_contacts(v);
  add_probe_bars(v);
  add_nodes(v);
  const double pitch = 0.034 * v.length;
  Panel& p = v.panel;
  add_names(p, v.names, v.length, v.top, pitch);
  double reach = v.top;
  for (const Label& l : p.labels) reach = std::max(reach, std::abs(l.y) + 0.5 * pitch);
  p.has_equal_scales = true;
  p.x.title = shown_heading("z", "mm");
  p.y.title = shown_heading("radius", "mm");
  p.x.first = -0.04 * v.length;
  p.x.last = 1.04 * v.length;
  p.y.first = -reach;
  p.y.last = reach;
  Figure f{.subtitle = "Layout, shaft and disks of given size to scale", .width = 860.0};
  f.notes = {
      "Symbols without scale: bearings, seals, probes, and the length and height of contacts. Gaps "
      "are drawn as 0.4 % of the shaft's length where they are less."};
  const auto is_symbol = [](const Disk& d) { return !(d.outer_diameter > 0.0); };
  if (std::ranges::any_of(model.structure.disks, is_symbol)) {
    f.notes.push_back(
        "Broken lines, not to scale: disks whose size the model does not give. Their height above "
        "the shaft says the polar inertia, as far as no contact says a radius.");
  }
  f.height = std::clamp(140.0 + 2.0 * reach / (1.08 * v.length) * 750.0, 260.0, 760.0);
  f.panels.push_back(std::move(p));
  return {f};
}

std::vector<Figure> layout_figures(const ResultView& result) {
  return layout_of(*result.model, *result.assembler);
}

}  // namespace

FigureKind layout_kind() {
  return {
      .name = "layout",
      .title = "Layout",
      .summary = "shaft and disks to scale, with bearings, seals, oil films and contacts",
      .subject = Subject::rotor,
      .needs_model = true,
      .make = layout_figures,
      .of_model = layout_of,
  };
}

}  // namespace whirl::inline io
