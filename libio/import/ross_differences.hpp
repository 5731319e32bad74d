#pragma once
/// What a model takes differently from ROSS.

#include <string>
#include <vector>

#include "libio/import/ross.hpp"

namespace whirl::inline io {

/// What means something else in a model than in ROSS, whatever the model is written like: tables,
/// shear coefficients, torques, cones, theories of elements, couplings.
///
/// @return  a sentence each
std::vector<std::string> differences_of(const RossRotor& rotor);

}  // namespace whirl::inline io
