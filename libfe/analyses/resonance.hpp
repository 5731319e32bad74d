#pragma once
/// Internal resonances: modes whose frequencies stand in a ratio of small integers, seen from the
/// rotor.

#include <vector>

#include "libfe/analyses/campbell.hpp"

namespace whirl::inline fe {

/// A speed at which two modes are in p:q resonance as seen from the rotor.
struct InternalResonance {
  double speed = 0.0;      ///< [rad/s]
  int p = 1, q = 1;        ///< without a common divisor, p >= q
  int fast = 0, slow = 0;  ///< branches of the Campbell diagram, from 0
  double frequency = 0.0;  ///< of both over p and q, seen from the rotor [rad/s]
};

/// Speeds between the first and the last of a diagram at which two of its modes meet
///
///   q |Omega - s_a omega_a| = p |Omega - s_b omega_b|,   s = 1 forward, -1 backward
///
/// A rotor that touches its stator can bounce there with both modes at once: periodic seen from
/// the rotor, quasi-periodic from outside. Contact stiffens it, so that it bounces somewhat above
/// the speed where the linear modes meet. Modes of mixed or no sense count as either.
///
/// @param largest  of p and q, 1 or more
/// @return  ascending speed, interpolated between those of the diagram by cubics
/// @source [Shaw2016]
std::vector<InternalResonance> internal_resonances(const Campbell& diagram, int largest);

}  // namespace whirl::inline fe
