#include "libdyn/motions/transient.hpp"

#include <algorithm>

#include "libbase/error.hpp"
#include "libdyn/system/require_coordinates.hpp"

namespace whirl::inline dyn {

long until_forces_repeat(const ContactSystem& system, long revolution) {
  const long repeats = std::max(1L, system.repeats_after());
  return (repeats - revolution % repeats) % repeats;
}

Trajectory run_transient(const Scene& scene, const MotionState& start,
                         const TransientOptions& options) {
  require_coordinates(scene.contacts);
  const long least = start.phase > 0.0 ? 1 : 0;
  Trajectory transient{.system = &scene.contacts,
                       .state = start,
                       .revolutions = std::max(least, options.revolutions)};
  transient.revolutions +=
      until_forces_repeat(scene.contacts, start.revolution + transient.revolutions);
  if (transient.revolutions == 0) return transient;
  integrate_single(transient, {.tolerance = options.tolerance, .watch = [&](long done) {
                                 if (options.progress) {
                                   options.progress(done, transient.revolutions);
                                 }
                                 return !options.is_stopped || !options.is_stopped();
                               }});
  return transient;
}

std::optional<MotionState> settled_state(const Trajectory& transient) {
  if (transient.outcome == Outcome::stopped_by_observer) return std::nullopt;
  if (transient.outcome == Outcome::reached_end) return transient.state;
  throw NumericalError(transient.failure.text());
}

}  // namespace whirl::inline dyn
