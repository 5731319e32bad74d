#pragma once
/// The engine for packs of three widths, by the best instruction set of the processor; a file each,
/// so that they are compiled at the same time.

#include <span>

#include "libdyn/system/trajectory.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/pattern.hpp"

namespace whirl::inline dyn {

/// @param observer  called with every step of a single motion; may be null
void run_two_packs(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                   const Observer* observer);
void run_one_pack(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                  const Observer* observer);
void run_single(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                const Observer* observer);

}  // namespace whirl::inline dyn
