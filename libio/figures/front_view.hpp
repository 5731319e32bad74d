#pragma once

#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// The layout of a rotor of bodies only: its contacts with stators, seen along the axis.
std::vector<Figure> front_view(const Model& model);

}  // namespace whirl::inline io
