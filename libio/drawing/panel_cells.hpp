#pragma once
/// Cells of a panel that are colored by their values, and the scale of these colors.

#include "libio/drawing/panel_layout.hpp"
#include "libio/drawing/svg.hpp"

namespace whirl::inline io {

/// Draws the cells of a panel, if there are any, with their values where these are to be printed.
void draw_cells(Svg& svg, const PanelFrame& frame);

/// Draws the scale of their colors right of the panel; categories have none.
void draw_color_bar(Svg& svg, const PanelFrame& frame);

}  // namespace whirl::inline io
