#include "libio/results/orbit_results.hpp"

#include "libdyn/studies/orbit_result.hpp"
#include "libio/results/columns.hpp"

namespace whirl::inline io {

void write_orbit(ResultWriter& file, const Scene& scene, const FoundOrbit& orbit) {
  write_result(file, orbit_result(scene, orbit));
  if (orbit.series) write_result(file, *orbit.series);
}

void write_rotating_orbit(ResultWriter& file, const Scene& scene, const Cycle& cycle) {
  write_result(file, orbit_result(scene, cycle));
}

}  // namespace whirl::inline io
