#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "libcontact/film.hpp"
#include "libcontact/films/short.hpp"

namespace whirl::inline contact {

enum class FilmTheory { short_bearing, long_bearing };
constexpr auto choices(FilmTheory) {
  return std::array{Choice<FilmTheory>{"short", FilmTheory::short_bearing},
                    Choice<FilmTheory>{"long", FilmTheory::long_bearing}};
}

enum class FilmExtent { half, full };
constexpr auto choices(FilmExtent) {
  return std::array{Choice<FilmExtent>{"half", FilmExtent::half},
                    Choice<FilmExtent>{"full", FilmExtent::full}};
}

/// Squeeze film damper: a film around a journal that whirls but does not turn, with its spring.
///
/// With v = (b, -a) / 2, which is the velocity over the clearance, Q = 1 - x^2 - y^2:
///
///   short, full   F = -4 pi s (Q v + 3 (x, y) (x, y).v) / Q^(5/2),   s = viscosity R L^3 / (4 c^2)
///   short, half   half of it is full of oil, that which is squeezed: as of law "short"
///   long, full    F = -2 pi l (2 Q v + 3 (x, y) (x, y).v) / ((3 - Q) Q^(3/2)),
///                 l = 6 viscosity R^3 L / c^2
///   long, half    that half, with the pressure of the surroundings at both of its ends
///
/// Along t from one end of that half to the other, with p = 2 |v|, H = 1 - X cos t - Y sin t:
///
///   d/dt (H^3 dP/dt) = -p sin t,   P(0) = P(pi) = 0,   F = -l integral P (cos t, sin t) dt
///
/// whose integrals of 1 / H^3 and its moments are derivatives by X and Y of
///
///   G = integral dt / H = 2 / sqrt(Q) arccot(-Y / sqrt(Q))
///
/// The kink of the half films where nothing moves is rounded as that of law "short".
///
/// @source [Vance1988] for centered circles; all films by integration
struct Squeeze {
  static constexpr std::string_view name = "squeeze";
  static constexpr bool is_dragged = false;

  FilmTheory theory = FilmTheory::short_bearing;
  FilmExtent extent = FilmExtent::half;
  double spring = 0.0;  ///< stiffness of the centering spring, a bearing beside the film [N/m]

  static constexpr auto fields() {
    return std::tuple{
        optional("theory", &Squeeze::theory, "", Range::any, "of the damper's length"),
        optional("extent", &Squeeze::extent, "", Range::any,
                 "how much of the circumference is full of oil"),
        optional("spring", &Squeeze::spring, "N/m", Range::nonnegative,
                 "stiffness of the centering spring, beside the film")};
  }

  /// Number of the formula: laws of one number are computed together.
  int formula() const { return (is_long() ? 2 : 0) + (is_full() ? 1 : 0); }

  double factor(const JournalBearing& b) const {
    if (!is_long()) return Short::factor(b);
    return 6.0 * b.viscosity * b.radius * b.radius * b.radius * b.length /
           (b.clearance * b.clearance);
  }

  template <class T>
  WHIRL_INLINE constexpr std::pair<T, T> force(const T& x, const T& y, const T& a,
                                               const T& b) const {
    if (is_full()) return is_long() ? long_full(x, y, a, b) : short_full(x, y, a, b);
    if (is_long()) return long_half(x, y, a, b);
    return Short::force(x, y, a, b);
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  constexpr bool is_long() const { return theory == FilmTheory::long_bearing; }
  constexpr bool is_full() const { return extent == FilmExtent::full; }

  template <class T>
  WHIRL_INLINE static constexpr std::pair<T, T> short_full(const T& x, const T& y, const T& a,
                                                           const T& b) {
    using std::sqrt;
    const T Q = 1.0 - (x * x + y * y);
    const T along = 3.0 * (x * b - y * a);
    const T weight = Q * Q * sqrt(Q);
    return {-(2.0 * pi * (Q * b + along * x) / weight), -(2.0 * pi * (along * y - Q * a) / weight)};
  }

  template <class T>
  WHIRL_INLINE static constexpr std::pair<T, T> long_full(const T& x, const T& y, const T& a,
                                                          const T& b) {
    using std::sqrt;
    const T Q = 1.0 - (x * x + y * y), twice = 2.0 * Q;
    const T along = 3.0 * (x * b - y * a);
    const T weight = (3.0 - Q) * (Q * sqrt(Q));
    return {-(pi * (twice * b + along * x) / weight), -(pi * (along * y - twice * a) / weight)};
  }

  /// Subscripts: derivatives of G; c, s: integrals of cos t and sin t over H^3, cc and cs of their
  /// products.
  template <class T>
  WHIRL_INLINE static constexpr std::pair<T, T> long_half(const T& x, const T& y, const T& a,
                                                          const T& b) {
    using std::sqrt;
    constexpr double kink = 1e-9;
    const T Q = 1.0 - (x * x + y * y), root = sqrt(Q);
    const T p = sqrt(a * a + b * b + kink * kink);
    const T X = -((x * a + y * b) / p), Y = (x * b - y * a) / p;
    const T D = 1.0 - X * X;
    const T G = 2.0 * arc_cotangent(-(Y / root)) / root;
    const T end = 2.0 * (Y / D), all = Y * G + 2.0;
    const T GX = X * (G + end) / Q, GY = all / Q;
    const T GXX = (Q + 2.0 * (X * X)) * (G + end) / (Q * Q) + X * (GX + 2.0 * (X * end / D)) / Q;
    const T GXY = Y * GX / Q + 2.0 * (X * all) / (Q * Q);
    const T GYY = (G + Y * GY) / Q + 2.0 * (Y * all) / (Q * Q);
    const T c = 2.0 * GX + X * GXX + Y * GXY, s = 2.0 * GY + X * GXY + Y * GYY;
    const T m = c / (GXX + GYY);  // where the pressure is highest, cos t = m
    const T across = 0.5 * (GXY - m * s), along = 0.5 * (GXX - m * c);
    return {-(a * across + b * along), a * along - b * across};
  }
};

}  // namespace whirl::inline contact
