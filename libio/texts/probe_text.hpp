#pragma once

#include <string>
#include <vector>

#include "libdyn/linear/static_study.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/found_orbit.hpp"

namespace whirl::inline io {

/// Angle of a probe in degrees, for an axial probe with the axis that it looks along: "90",
/// "90 along z".
std::string angle_text(const ProbeLabel& probe);

/// A reading [m] in the unit of its probe: "12.3 um".
std::string reading_text(double reading, const ProbeLabel& probe);

/// Names and frequency of forces of a response: "pump, motor (2x)".
template <class Forced>
std::string force_text(const Forced& forced) {
  return forced.forces.empty() ? forced.force : forced.forces + " (" + forced.force + ")";
}

/// Peaks along every probe, peak to peak; empty without probes.
std::string text_of(const std::vector<ProbeResponse>& probes);

/// Readings of forces of other frequencies; a dash where they are not bounded; empty without
/// probes.
/// @param speeds  of the readings [rad/s]
std::string text_of(const std::vector<ForcedReading>& readings, const std::vector<double>& speeds);

/// What every probe reads of a rotor at rest; empty without probes.
std::string text_of(const std::vector<RestingProbe>& probes);

/// Mean and peak to peak along every probe; empty without probes.
std::string text_of(const std::vector<ProbeSummary>& probes);

/// Peak to peak along every probe; empty without probes.
std::string text_of(const std::vector<OrbitProbe>& probes);

}  // namespace whirl::inline io
