#pragma once
/// Orbits and branches as bytes that go from one process to another, and back: see
/// libbase/structs/travel.hpp.

#include "libdyn/branches/branch.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/studies/bouncing.hpp"
#include "libdyn/studies/travel.hpp"

namespace whirl::inline dyn {

template <class Bytes>
void travel(Bytes& bytes, Is<PeriodicOrbit> auto& orbit) {
  auto& [period, revolution, states, tangents, residual, residuals, multipliers, contacts,
         failure] = orbit;
  bytes(period, revolution, states, tangents, residual, residuals, multipliers, contacts, failure);
}

template <class Bytes>
void travel(Bytes& bytes, Is<AutonomousOrbit> auto& orbit) {
  auto& [state, period, residual, residuals, multipliers, contacts, failure] = orbit;
  bytes(state, period, residual, residuals, multipliers, contacts, failure);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Bouncing> auto& bouncing) {
  auto& [speed, turns, cycle, lines] = bouncing;
  bytes(speed, turns, cycle, lines);
}

template <class Bytes>
void travel(Bytes& bytes, Is<BranchPoint> auto& point) {
  auto& [value, z, tangent, step, multipliers, residual, contacts] = point;
  bytes(value, z, tangent, step, multipliers, residual, contacts);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Bifurcation> auto& bifurcation) {
  auto& [kind, at, after, contact, change, multiplier] = bifurcation;
  bytes(kind, at, after, contact, change, multiplier);
}

template <class Bytes>
void travel(Bytes& bytes, Is<BranchEnd> auto& end) {
  auto& [kind, text, reason] = end;
  bytes(kind, text, reason);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Branch> auto& branch) {
  auto& [period, points, bifurcations, end] = branch;
  bytes(period, points, bifurcations, end);
}

template <class Bytes>
void travel(Bytes& bytes, Is<OrbitMeasure> auto& measure) {
  auto& [radii, work, probe_peak_to_peak, sections] = measure;
  bytes(radii, work, probe_peak_to_peak, sections);
}

}  // namespace whirl::inline dyn
