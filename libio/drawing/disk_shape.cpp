#include "libio/drawing/disk_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::inline io {

namespace {

/// Height of a symbol above the shaft, over the rotor's length: it says the polar inertia, and is
/// seen of a disk without one, too.
double symbol_height(const Disk& disk, const std::vector<Disk>& all) {
  constexpr double lowest = 0.015, highest = 0.06;
  double largest = 0.0;  // of the disks that are drawn so
  for (const Disk& other : all) {
    if (!(other.outer_diameter > 0.0)) largest = std::max(largest, other.Ip);
  }
  return lowest + (largest > 0.0 ? (highest - lowest) * disk.Ip / largest : 0.0);
}

}  // namespace

DiskShape disk_shape(const Disk& disk, const Model& model, const Assembler& assembler) {
  DiskShape shape{0.5 * disk.outer_diameter, 0.5 * std::max(disk.inner_diameter, 0.0), disk.width};
  const bool has_width = disk.width > 0.0, has_diameter = disk.outer_diameter > 0.0;
  const double length = model.structure.length();
  if (!has_width) shape.width = symbol_width * length;
  if (!has_diameter) {
    const Point point = assembler.point(disk.at);
    const double shaft = 0.5 * diameter_at(model.structure, assembler.mesh(), point.index);
    shape.outer_radius = shaft + symbol_height(disk, model.structure.disks) * length;
    double touched = 0.0;
    for (const Contact& c : model.contacts) {
      if (assembler.point(c.at) == point) touched = std::max(touched, c.friction.radius);
    }
    if (touched > 1.001 * shaft) shape.outer_radius = touched;
  }
  shape.not_given = has_width ? (has_diameter ? "" : "diameter") : has_diameter ? "width" : "size";
  return shape;
}

std::string legend_name(const DiskShape& shape) {
  if (shape.not_given.empty()) return "disk";
  return fmt::format("disk, {} not given (not to scale)", shape.not_given);
}

}  // namespace whirl::inline io
