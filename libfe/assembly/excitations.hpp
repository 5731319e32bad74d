#pragma once
/// Loads that do not follow from the motion: gravity, unbalance, bow and forces, in one form.

#include <string>
#include <vector>

#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

struct Force;
struct Rotor;

/// How the amplitude of a load grows with the speed.
enum class Growth {
  none,
  unbalance  ///< by the square of the speed
};

/// A load f(t) = Re(amplitude e^(i alpha)). Its angle alpha is that of the shaft times an order, or
/// the time times a frequency of its own; of constant loads it is zero.
struct Excitation {
  double order = 0.0;      ///< of the speed; 0: it does not follow it
  double frequency = 0.0;  ///< of its own [rad/s]; 0, and no order: constant
  Growth growth = Growth::none;
  /// Full vector, see DofMap [N, N.m], of an unbalance over Omega^2 [kg.m]; of constant loads the
  /// real part counts.
  CVec amplitude;
  std::string names{};           ///< of the forces in it: "pump, motor"
  const Rotor* rotor = nullptr;  ///< whose own speed it has, of a structure that lives on

  bool is_constant() const { return order == 0.0 && frequency == 0.0 && !rotor; }
  /// Whether it has the frequency of the speed.
  bool is_synchronous() const { return order == 1.0; }
  /// What the amplitude is multiplied with at a speed.
  double growth_at(double Omega) const;
  /// Rate of alpha at a speed [rad/s].
  double frequency_at(double Omega) const;
  /// "2x", "40 Hz", "speed of hp".
  std::string label() const;
};

/// Gravity, constant forces and the bow of shafts that stand, one after the other.
std::vector<Excitation> constant_excitations(const Assembler& assembler);
/// All that has the frequency of the speed, one after the other: unbalance, bow, forces of order 1,
/// unbalance of shafts that turn against the first one at its speed, bow of shafts of that speed.
std::vector<Excitation> synchronous_excitations(const Assembler& assembler);
/// Forces of other frequencies, unbalance and bow of shafts of other speeds, those of one frequency
/// and growth together; orders before frequencies, ascending.
std::vector<Excitation> other_excitations(const Assembler& assembler);

/// All loads at a speed: the constant one, the synchronous one, then the others, those of one
/// frequency and growth together. The first two are there even where they are zero.
std::vector<Excitation> excitations_at(const Assembler& assembler, double Omega);

/// Whether any of them loads the rotor at a speed.
bool acts_at(const std::vector<Excitation>& excitations, double Omega);

/// Sum of amplitudes at a speed, a full vector [N, N.m].
CVec sum_at(const std::vector<Excitation>& excitations, const Assembler& assembler, double Omega);
/// The constant ones at a speed [N, N.m].
Vec static_load(const Assembler& assembler, double Omega);
/// Whether that is the same at all speeds.
bool is_static_load_steady(const Assembler& assembler);

/// Complex amplitude of a force, a full vector [N, N.m]; of a constant one the real part counts.
///
/// An acceleration a of the base is the load -M a of all that has weight: motions are relative to
/// the base.
CVec amplitude_of(const Force& force, const Assembler& assembler);

/// What accelerates all that has weight for good: gravity, and a constant acceleration of the base
/// taken off (x, y) [m/s^2].
Vec2 steady_acceleration(const Structure& structure);

/// Highest frequency of forces at a speed; 0: there are none [rad/s].
double highest_frequency(const Structure& structure, double Omega);

bool has_constant_force(const Structure& structure);
bool has_synchronous_force(const Structure& structure);
/// Whether there are other_excitations().
bool has_oscillating_force(const Structure& structure);
/// Whether anything has the frequency of the speed.
bool has_synchronous_load(const Structure& structure);

}  // namespace whirl::inline fe
