#pragma once
/// Periodic orbits in a result file.

#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/orbit_search.hpp"

namespace whirl::inline io {

class ResultWriter;

/// A motion on an orbit, so that others begin there. If the orbit was found, also group /orbit: its
/// multipliers and, for harmonic balance in the stationary frame, the motion of all points.
void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const FoundOrbit& orbit);
void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const RotatingOrbit& orbit);
/// The motion alone.
void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const SearchedOrbit& orbit);

}  // namespace whirl::inline io
