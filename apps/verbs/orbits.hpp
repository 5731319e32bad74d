#pragma once
/// What orbit, continue and torus share: options, and where they begin.

#include <optional>

#include "apps/invocation.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/branch_point.hpp"

namespace whirl::inline cli {

/// Where orbits are to be closed, as seen from there: --frame.
/// @throws ModelError  for other frames than the stationary and the rotating one
OrbitFrame orbit_frame(const Invocation& call);

/// That of --method; --harmonics and --verify, if given, must go with it.
/// @throws ModelError  for an unknown one, or for options of the other
OrbitMethod orbit_method(const Invocation& call);

/// --harmonics; 0: left out.
/// @throws ModelError  if the speed itself, harmonic number `period`, is not among them
int harmonics_of(const Invocation& call, int period);

/// The motion after --discard revolutions from the model's start, or from --from (there left out: 0),
/// at phase 0; its outcome says whether it got there.
Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene);

/// The state there; nothing: it was stopped before.
/// @throws NumericalError  if the motion fails
std::optional<MotionState> settled_state(const Invocation& call, const Model& model,
                                         const Scene& scene);

/// The point number --point of the file of --from, counted over all branches from 1.
/// @throws ModelError  if there is no such point
/// @throws FileError   if the file holds no branches
BranchStart branch_start(const Invocation& call);

/// Orbits near random starts: --starts.
Report search_orbits(const Invocation& call, const Model& model);

/// An orbit that repeats as seen from the rotor, whose period is any: --frame rotating.
Report rotating_orbit(const Invocation& call, const Model& model);

}  // namespace whirl::inline cli
