#pragma once

#include <string>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline io {

/// A side view of the rotor for the terminal: shaft and disks, and below them what is where.
/// @param columns  width of the drawing
std::string draw_layout(const Model& model, const Assembler& assembler, int columns = 72);

}  // namespace whirl::inline io
