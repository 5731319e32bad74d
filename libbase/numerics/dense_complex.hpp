#pragma once
/// Eigenpairs of complex matrices by Eigen, apart from dense.hpp, which nearly all files include.

#include <optional>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

/// A v = lambda v; nothing if the iteration does not converge or A is not finite.
std::optional<GeneralModes> general_modes(const CMat& A);

}  // namespace whirl::inline base
