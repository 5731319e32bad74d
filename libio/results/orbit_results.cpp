#include "libio/results/orbit_results.hpp"

#include "libdyn/studies/orbit_result.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"

namespace whirl::inline io {

void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const FoundOrbit& orbit) {
  write_end(file, model, scene, orbit.state());
  if (!orbit.is_good()) return;
  write_result(file, orbit_result(scene, orbit));
  if (orbit.series) write_result(file, *orbit.series);
}

void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const RotatingOrbit& orbit) {
  write_end(file, model, scene, orbit.state);
  if (orbit.is_good()) write_result(file, orbit_result(scene, orbit));
}

void write_orbit(ResultWriter& file, const Model& model, const Scene& scene,
                 const SearchedOrbit& orbit) {
  write_end(file, model, scene, orbit.orbit.states[0]);
}

}  // namespace whirl::inline io
