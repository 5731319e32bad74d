#pragma once
/// How a disk is drawn: as large as the model says, or as a symbol. Every drawing asks here.

#include <string>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline io {

constexpr double symbol_width = 0.006;  ///< of a disk without a width, over the rotor's length

/// A disk as it is drawn. A disk whose size the model does not give is a symbol, not to scale:
/// thin, so that it hides nothing, drawn broken, its height saying the polar inertia.
struct DiskShape {
  double outer_radius = 0.0, inner_radius = 0.0;  ///< [m]
  double width = 0.0;                             ///< [m]
  std::string not_given;  ///< "size", "diameter" or "width"; empty: all as the model gives it
};

/// The shape of a disk on the shaft.
///
/// A width that is not given is symbol_width of the rotor's length. A radius that is not given is
/// the one at which a contact of the same node touches the disk, or else above the shaft by 1.5 %
/// to 6 % of the length, linear in the polar inertia over the largest one of such disks.
DiskShape disk_shape(const Disk& disk, const Model& model, const Assembler& assembler);

/// "disk", or of a symbol "disk, size not given (not to scale)", for legends.
std::string legend_name(const DiskShape& shape);

}  // namespace whirl::inline io
