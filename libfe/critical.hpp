#pragma once
/// Critical speeds: speeds at which an excitation of a given order meets a natural frequency.

#include <vector>

#include "libfe/modes.hpp"

namespace whirl {

struct CriticalOptions {
  int count = 6;       ///< lowest ones wanted
  double order = 1.0;  ///< excitation frequency over spin speed; 1: unbalance
};

/// A critical speed of the undamped system, and of the damped one where it has one nearby.
struct Critical {
  double speed = 0.0;         ///< undamped [rad/s]
  double damped_speed = 0.0;  ///< Im lambda(Omega) = order * Omega [rad/s]; NaN if there is none
  Whirl whirl = Whirl::planar;
  CVec shape;  ///< coordinates of the system
};

/// Critical speeds directly from the pencil with omega = order * Omega.
///
///   K q = omega^2 (M - i G / order) q
///
/// Forward and backward ones come together; a disk with Ip > Id has no forward tilting one. Where
/// stiffness depends on speed, each is iterated until it is a critical speed of the stiffness at
/// itself. The damped ones start from these and follow Im lambda(Omega) = order * Omega.
///
/// @throws ModelError      if the rotor is free
/// @throws NumericalError  if an eigensolver or the iteration fails
/// @source [Friswell2010], sec. 6.5
std::vector<Critical> critical_speeds(const Assembler& assembler, const CriticalOptions& options);

/// Those of one system without damping, the lowest ones in ascending order; damped_speed is NaN.
/// @throws NumericalError  if the eigensolver fails, or the stiffness is not positive definite
std::vector<Critical> undamped_criticals(const System& system, const CriticalOptions& options);

}  // namespace whirl
