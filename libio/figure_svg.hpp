#pragma once

#include <string>

#include "libio/figure.hpp"

namespace whirl {

/// A figure as an SVG file, for papers and light backgrounds.
///
/// Long lines are thinned to what can be seen, dots that hide each other are written once; the
/// largest study stays a file of a few megabytes.
std::string svg_of(const Figure& figure);

}  // namespace whirl
