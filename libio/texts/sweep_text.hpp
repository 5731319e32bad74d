#pragma once

#include <string>

#include "libdyn/studies/sweep.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

/// Stretches of values with the same motion, of every way.
std::string text_of(const SweepResult& sweep, const ParameterAxis& axis);

}  // namespace whirl::inline io
