#pragma once

#include <vector>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduce.hpp"

namespace whirl::inline fe {

/// Oscillatory modes of a reduced system, as motions of the dofs that were reduced: those of its
/// equations, which are few, so that the reduction's errors are in them.
/// @param count  wanted; fewer come back if there are fewer
/// @return       ascending frequency
/// @throws NumericalError  if the eigenvalue iteration fails
std::vector<Mode> reduced_modes(const ReducedSystem& reduced, int count);

}  // namespace whirl::inline fe
