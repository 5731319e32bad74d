#include "libio/figures/rotor_backdrop.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/drawing/disk_shape.hpp"
#include "libio/export/vtk_scene.hpp"
#include "libio/figures/common.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io::figures {

namespace {

constexpr double symbol = 0.011;          ///< half width of a bearing, of the shaft's length
constexpr double bearing_height = 0.42;   ///< of the largest radius
constexpr double contact_height = 0.16;   ///< likewise
constexpr double narrowest_disk = 0.008;  ///< of the shaft's length: it is seen

/// A closed area behind the curves; it does not decide about axes.
Curve area(const std::string& name, Paint paint, std::vector<double> x, std::vector<double> y,
           double fill, const std::string& hover = "") {
  Curve c{.name = name, .paint = paint};
  c.x = std::move(x);
  c.y = std::move(y);
  c.width = 0.7;
  c.fill = fill;
  c.has_line = false;
  c.is_key = false;
  if (!hover.empty()) c.hover.assign(c.x.size(), hover);
  return c;
}

Curve box(const std::string& name, Paint paint, double from, double to, double low, double high,
          double fill, const std::string& hover) {
  return area(name, paint, {from, to, to, from, from}, {low, low, high, high, low}, fill, hover);
}

/// A disk whose size is not given: a broken line, as thick in every picture.
Curve symbol_line(const std::string& name, double at, double axis, double radius,
                  const std::string& hover) {
  Curve c{.name = name, .paint = Paint::disk};
  c.x = {at, at};
  c.y = {axis - radius, axis + radius};
  c.dash = Dash::dashed;
  c.is_key = false;
  c.hover.assign(2, hover);
  return c;
}

/// @param factor  height in the panel per radius [m]
void add_disk(Panel& panel, const Disk& disk, const ResultView& result, double axis,
              double factor) {
  const auto z = result.assembler->mesh().position_of(result.assembler->point(disk.at));
  if (!z) return;
  const double at = *z;
  const DiskShape shape = disk_shape(disk, *result.model, *result.assembler);
  const double radius = factor * shape.outer_radius;
  if (!shape.not_given.empty()) {
    panel.curves.push_back(symbol_line(legend_name(shape), per_mm() * at, axis, radius, disk.name));
    return;
  }
  const double least = narrowest_disk * result.model->structure.length();
  const double half = 0.5 * std::max(shape.width, least);
  panel.curves.push_back(box("disk", Paint::disk, per_mm() * (at - half), per_mm() * (at + half),
                             axis - radius, axis + radius, 0.35, disk.name));
}

}  // namespace

void add_rotor(Panel& panel, const ResultView& result, double axis, double height) {
  if (!result.assembler) return;
  const Model& model = *result.model;
  const Structure& s = model.structure;
  const double length = s.extent();
  if (!(length > 0.0)) return;
  const VtkScene scene = vtk_scene(model, *result.assembler);
  const Mesh& mesh = result.assembler->mesh();
  double largest = 0.0;
  for (const VtkShaftPiece& p : scene.shaft) {
    largest = std::max({largest, p.left_radius, p.right_radius});
  }
  for (const VtkDisk& d : scene.disks) largest = std::max(largest, d.outer_radius);
  if (!(largest > 0.0)) return;
  const double factor = height / largest;
  const auto position = [&](const Station& station) {  // [m]; -1: not on the shaft
    return mesh.position_of(result.assembler->point(station)).value_or(-1.0);
  };

  const auto radius_at = [&](const Station& station) {  // [m]; 0: not on the shaft
    const Point p = result.assembler->point(station);
    return p.kind == Point::Kind::node ? 0.5 * diameter_at(s, mesh, p.index) : 0.0;
  };
  const auto add_part = [&](const auto& part, double from, double to) {
    const double left = 0.5 * factor * part.left.outer, right = 0.5 * factor * part.right.outer;
    panel.curves.push_back(
        area("", Paint::shaft,
             {per_mm() * from, per_mm() * to, per_mm() * to, per_mm() * from, per_mm() * from},
             {axis + left, axis + right, axis - right, axis - left, axis + left}, 0.3));
  };
  for (const Structure::Shaft& shaft : s.shafts()) {
    double z = shaft.start;
    for (const Segment& segment : shaft.segments) {
      add_part(segment, z, z + segment.length);
      z += segment.length;
    }
  }
  for (const Layer& layer : s.layers) {
    const LayerSpan span = span_of(layer, s, mesh);
    add_part(layer, span.from, span.to);
  }
  for (const Disk& disk : s.disks) add_disk(panel, disk, result, axis, factor);
  const double half = per_mm() * symbol * length;
  const auto add_bearing = [&](const Station& station, const std::string& name) {
    const double at = per_mm() * position(station);
    if (at < 0.0) return;
    const double top = axis - factor * radius_at(station);
    panel.curves.push_back(
        area("bearing", Paint::bearing, {at, at + half, at - half, at},
             {top, top - bearing_height * height, top - bearing_height * height, top}, 0.75, name));
  };
  for (const Connection& b : s.bearings) add_bearing(b.from, b.name);
  for (const OilFilm& f : model.films) add_bearing(f.at, f.name);
  for (const Contact& b : rolling_bearings(model.contacts)) add_bearing(b.at, b.name);
  for (const Connection& seal : s.seals) {
    const double at = per_mm() * position(seal.from);
    if (at < 0.0) continue;
    const double radius = radius_at(seal.from);
    for (const double side : {1.0, -1.0}) {
      const double tip = axis + side * 1.08 * factor * radius;
      const SealShape shape = seal_shape(at, half, tip, tip + side * contact_height * height);
      panel.curves.push_back(area("seal", Paint::seal, shape.x, shape.y, 0.75, seal.name));
    }
  }
  for (const Contact& c : stator_contacts(model.contacts)) {
    const double at = per_mm() * position(c.at);
    if (at < 0.0) continue;
    const double radius = c.friction.radius > 0.0 ? c.friction.radius : radius_at(c.at);
    for (const double side : {1.0, -1.0}) {
      const double low = axis + side * 1.08 * factor * radius;
      panel.curves.push_back(box("contact", Paint::stator, at - half, at + half, low,
                                 low + side * contact_height * height, 0.6, c.name));
    }
  }
}

}  // namespace whirl::inline io::figures
