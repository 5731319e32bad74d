#pragma once

#include <string_view>
#include <utility>

#include "libcontact/film.hpp"

namespace whirl::inline contact {

/// Film of a short journal bearing, half of it full of oil.
///
///   F = -2 s integral |b cos t - a sin t|_+ (cos t, sin t) / (1 - x cos t - y sin t)^3 dt,
///   s = viscosity radius length^3 / (4 clearance^2)
///
/// The integral goes over the half of the circle where the film is squeezed. In closed form, with
/// p = sqrt(a^2 + b^2), U = x b - y a, Q = 1 - x^2 - y^2:
///
///   F = -s / Q (3 V (x, y) + G (b, -a) + 2 S (a, b)),
///   G = 2 / sqrt(Q) arccot(-U / (p sqrt(Q))),   V = (2 p + U G) / Q,
///   S = -(x a + y b) p / (p^2 Q + U^2)
///
/// At a = b = 0, where the half changes sides, the force is zero and has a kink. The kink is
/// rounded over 1e-9 of the rates' scale, p = sqrt(a^2 + b^2 + (1e-9)^2), so that steps pass
/// through it; elsewhere this is below rounding.
///
/// Away from the oil (U < 0) near the wall, V and the force keep a relative error of rounding over
/// Q^2: they are small there.
///
/// @source [Capone1991] for the closed form; the sign of the S term in y by quadrature
struct Short {
  static constexpr std::string_view name = "short";
  static constexpr bool is_dragged = true;

  static constexpr auto fields() { return std::tuple{}; }
  static constexpr int formula() { return 0; }

  static double factor(const JournalBearing& b) {
    return 0.25 * b.viscosity * b.radius * b.length * b.length * b.length /
           (b.clearance * b.clearance);
  }

  /// @param a, b  over the rate of the phase, which is their scale
  template <class T>
  WHIRL_INLINE static constexpr auto force(const T& x, const T& y, const T& a, const T& b) {
    using std::sqrt;
    constexpr double kink = 1e-9;
    const auto Q = 1.0 - (x * x + y * y);
    const auto root = sqrt(Q);
    const auto squeeze = a * a + b * b;
    const auto p = sqrt(squeeze + kink * kink);
    const auto width = p * root;
    const auto U = x * b - y * a;
    const auto v = -(U / width);
    const auto G = 2.0 * arc_cotangent(v) / root;
    const auto V = (2.0 * (squeeze / p) + U * G) / Q;
    const auto S = -((x * a + y * b) / (width * root * (1.0 + v * v)));
    const auto along = 3.0 * V, turned = 2.0 * S;
    return std::pair(-((along * x + G * b + turned * a) / Q),
                     -((along * y - G * a + turned * b) / Q));
  }
};

}  // namespace whirl::inline contact
