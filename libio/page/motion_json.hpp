#pragma once

#include "libio/drawing/figure_json.hpp"
#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// What moves in a result, for the picture in space: the bodies of vtk_scene, and the end of a
/// trajectory or the shapes of modes. An empty object where nothing moves.
Record motion_record(const ResultView& result, ArrayStore& arrays);

}  // namespace whirl::inline io
