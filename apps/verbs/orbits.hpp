#pragma once
/// What orbit, continue and torus share: options, and where they begin.

#include <string>

#include "apps/verbs/study.hpp"
#include "libdyn/motions/transient.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libio/model/branch_parameters.hpp"

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

/// What --over, --at and --points say.
/// @throws ModelError  as branch_parameters
BranchParameters asked_parameters(const Invocation& call, const Model& model);

/// The motion after --discard revolutions from the model's start, or from --from (there left out: 0).
Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene);

/// A report with its headline, and with the notes on the model.
Report orbit_report(const Invocation& call, const Model& model, const std::string& what);

/// Says what was there already, that it was stopped, and where the result is.
void add_kept(const Invocation& call, const std::string& points, long resumed, Report& report);

/// Orbits near random starts: --starts.
Report search_orbits(const Invocation& call, const Model& model);

}  // namespace whirl::inline cli
