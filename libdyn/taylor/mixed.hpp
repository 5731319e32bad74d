#pragma once
/// Trajectories of systems that need not be alike.

#include <vector>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

/// Integrates trajectories of any systems, in batches of those that have the same shape, and one by
/// one where that is faster.
void integrate_mixed(std::vector<Trajectory>& all, const BatchOptions& options);

}  // namespace whirl::inline dyn
