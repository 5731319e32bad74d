#pragma once

#include "libio/figures/figures.hpp"

namespace whirl::inline io::figures {

/// Draws the rotor faintly behind curves over the position along the shaft [shown unit of mm]: its
/// outline and disks, enlarged across the axis, bearings as triangles below, seals and contacts as
/// rings around it.
///
/// Does nothing for a result whose model cannot be read, or that has no shaft.
///
/// @param axis    height of the rotor's axis in the panel
/// @param height  of its largest radius, in numbers of the panel's y
void add_rotor(Panel& panel, const ResultView& result, double axis, double height);

}  // namespace whirl::inline io::figures
