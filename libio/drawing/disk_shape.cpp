#include "libio/drawing/disk_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::inline io {

DiskShape disk_shape(const Disk& disk, const Model& model, const Assembler& assembler) {
  constexpr double symbol_height = 0.04;  // above the shaft, of the rotor's length
  DiskShape shape{0.5 * disk.outer_diameter, 0.5 * std::max(disk.inner_diameter, 0.0), disk.width};
  const bool has_width = disk.width > 0.0, has_diameter = disk.outer_diameter > 0.0;
  const double length = model.structure.length();
  if (!has_width) shape.width = symbol_width * length;
  if (!has_diameter) {
    const Point point = assembler.point(disk.at);
    const double z = assembler.mesh().z[static_cast<std::size_t>(point.index)];
    const double shaft = 0.5 * shaft_diameter(model.structure, assembler.mesh(), z);
    shape.outer_radius = shaft + symbol_height * length;
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
  return fmt::format("disk, {} not given (symbol)", shape.not_given);
}

}  // namespace whirl::inline io
