#pragma once
/// Loads that do not follow from the motion, by their frequencies.

#include <string>
#include <vector>

#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

/// All forces of one frequency, neither zero nor that of the speed: f(t) = Re(amplitude e^(i w t)).
struct OscillatingLoad {
  double order = 0.0;      ///< of the speed; 0: it does not follow it
  double frequency = 0.0;  ///< of its own [rad/s]
  CVec amplitude;          ///< full vector, see DofMap [N, N.m]
  std::string forces{};    ///< their names: "pump, motor"

  /// w at a speed [rad/s].
  double at(double Omega) const { return order > 0.0 ? order * Omega : frequency; }
  /// "2x", "40 Hz".
  std::string label() const;
};

/// Complex amplitude of a force, a full vector [N, N.m]; of a constant one the real part counts.
///
/// An acceleration a of the base is the load -M a of all that has weight: motions are relative to
/// the base.
CVec amplitude_of(const Force& force, const Assembler& assembler);

/// Gravity and constant forces [N, N.m].
Vec static_load(const Assembler& assembler);

/// Amplitude of all that has the frequency of the speed: Assembler::turning_load and forces of
/// order 1 [N, N.m].
CVec synchronous_load(const Assembler& assembler, double Omega);
/// Forces of order 1 alone; empty: there are none.
CVec synchronous_forces(const Assembler& assembler);

/// The others, orders before frequencies, ascending.
std::vector<OscillatingLoad> oscillating_loads(const Assembler& assembler);

/// What accelerates all that has weight for good: gravity, and a constant acceleration of the base
/// taken off (x, y) [m/s^2].
Vec2 steady_acceleration(const Structure& structure);

/// Highest frequency of forces at a speed; 0: there are none [rad/s].
double highest_frequency(const Structure& structure, double Omega);

bool has_constant_force(const Structure& structure);
/// Whether there are oscillating_loads().
bool has_oscillating_force(const Structure& structure);
/// Whether anything has the frequency of the speed.
bool has_synchronous_load(const Structure& structure);

}  // namespace whirl::inline fe
