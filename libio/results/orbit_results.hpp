#pragma once
/// A periodic orbit in a result file.

#include "libdyn/studies/found_orbit.hpp"

namespace whirl::inline io {

class ResultWriter;

/// Group /orbit: its multipliers, and the motion of all points.
void write_orbit(ResultWriter& file, const Scene& scene, const FoundOrbit& orbit);

/// The same of an orbit that repeats as seen from the rotor: its multipliers.
void write_rotating_orbit(ResultWriter& file, const Scene& scene, const Cycle& cycle);

}  // namespace whirl::inline io
