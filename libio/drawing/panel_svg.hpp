#pragma once
/// Panels of a figure in an SVG picture: axes, cells, curves and names at the places of
/// panel_layout.hpp.

#include <string>

#include "libio/drawing/figure.hpp"
#include "libio/drawing/panel_layout.hpp"
#include "libio/drawing/svg.hpp"

namespace whirl::inline io {

namespace figure_style {

/// Colors on white.
const char* color_of(Paint paint);
const char* text_color_of(Paint paint);
std::string dashes_of(Dash dash);

}  // namespace figure_style

/// Draws a panel with its axes.
void draw_panel(Svg& svg, const PanelFrame& frame);

}  // namespace whirl::inline io
