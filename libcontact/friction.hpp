#pragma once

#include <array>
#include <cmath>
#include <tuple>

#include "libbase/structs/field.hpp"

namespace whirl::inline contact {

/// What the friction force opposes.
enum class Slip {
  actual,  ///< the slip velocity Omega R + whirl
  forward  ///< always the sense of the spin
};
constexpr auto choices(Slip) {
  return std::array{Choice<Slip>{"actual", Slip::actual}, Choice<Slip>{"forward", Slip::forward}};
}

/// Coulomb friction.
///
///   T = mu N s,   s = sign(v_t), or tanh(v_t / tolerance) if a tolerance is given
struct Friction {
  double mu = 0.0;
  Slip slip = Slip::actual;
  double radius = 0.0;     ///< of the contact on the rotor, R in v_t = Omega R + whirl [m]
  double tolerance = 0.0;  ///< width of the smoothed sign [m/s]; 0: exact switching, with sticking

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        optional("friction", &Friction::mu, "", nonnegative, "Coulomb coefficient"),
        optional("slip", &Friction::slip, "", any, "what friction opposes"),
        alternative(
            "radius", &Friction::radius, "m", nonnegative,
            "of the contact, for the slip velocity; left out: half the shaft's diameter there"),
        optional("slip_tolerance", &Friction::tolerance, "m/s", nonnegative,
                 "width of a smoothed sign of the slip; 0: exact switching, with sticking")};
  }

  /// Whether slip has a sign of its own that switches and can stick.
  bool is_exact() const { return mu > 0.0 && slip == Slip::actual && tolerance == 0.0; }

  /// Share of mu N that acts, -1 to 1, where it does not switch exactly.
  double smooth_share(double slip_velocity) const {
    return slip == Slip::forward ? 1.0 : std::tanh(slip_velocity / tolerance);
  }
};

}  // namespace whirl::inline contact
