#pragma once
/// Periodic orbits of a rotor, however they are found.

#include <array>

#include "libbase/field.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl {

/// How orbits are found.
enum class OrbitMethod { shooting, harmonic_balance };
constexpr auto choices(OrbitMethod) {
  return std::array{Choice<OrbitMethod>{"shooting", OrbitMethod::shooting},
                    Choice<OrbitMethod>{"harmonic-balance", OrbitMethod::harmonic_balance}};
}

/// Where orbits are seen from, to be closed.
enum class OrbitFrame { stationary, rotating };
constexpr auto choices(OrbitFrame) {
  return std::array{Choice<OrbitFrame>{"stationary", OrbitFrame::stationary},
                    Choice<OrbitFrame>{"rotating", OrbitFrame::rotating}};
}

/// Time after which a motion from a start comes back as seen from the rotor [s].
/// @throws NumericalError  if it does not
double guessed_period(const Scene& scene, const Vec& start);

}  // namespace whirl
