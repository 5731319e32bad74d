#pragma once
/// Values of functions between the places at which they are known.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "libbase/structs/field.hpp"

namespace whirl::inline base {

/// How values between the places are found.
enum class Interpolation {
  linear,
  pchip  ///< cubic in every interval, smooth at the places, without extremes between them
};
constexpr auto choices(Interpolation) {
  return std::array{Choice<Interpolation>{"linear", Interpolation::linear},
                    Choice<Interpolation>{"pchip", Interpolation::pchip}};
}

/// Places that an interpolated value depends on: `count` places from `first` on. The value lies
/// between place `below` and the next one; beyond the ends it is the value at `below`.
struct Neighborhood {
  std::size_t first = 0, count = 1;
  std::size_t below = 0;
  bool is_beyond = false;
};

/// Neighborhood of x among ascending places, at least one.
inline Neighborhood neighborhood(std::span<const double> places, double x, Interpolation how) {
  const auto above = std::upper_bound(places.begin(), places.end(), x);
  if (above == places.begin()) return {0, 1, 0, true};
  const auto last = places.size() - 1;
  if (above == places.end()) return {last, 1, last, true};
  const auto below = static_cast<std::size_t>(above - places.begin()) - 1;
  if (how == Interpolation::linear) return {below, 2, below, false};
  const std::size_t first = below > 0 ? below - 1 : 0;
  return {first, std::min(below + 2, last) - first + 1, below, false};
}

/// Slope that pchip gives a function at one of its places.
///
///   1/d = (w1/m1 + w2/m2) / (w1 + w2),   w1 = 2 h2 + h1,   w2 = h2 + 2 h1
///
/// between intervals of widths h1, h2 with slopes m1, m2 of one sign, else zero; at an end the
/// slope of the parabola through three places, limited so that the function stays monotone.
///
/// @param x  ascending, two places at least
/// @param y  values there
/// @source [FritschCarlson1980], with the harmonic means of [FritschButland1984]
inline double pchip_slope(std::span<const double> x, std::span<const double> y, std::size_t i) {
  const auto width = [&](std::size_t k) { return x[k + 1] - x[k]; };
  const auto slope = [&](std::size_t k) { return (y[k + 1] - y[k]) / width(k); };
  const std::size_t last = x.size() - 1;
  if (last == 1) return slope(0);
  if (i > 0 && i < last) {
    const double h1 = width(i - 1), h2 = width(i), m1 = slope(i - 1), m2 = slope(i);
    if (!(m1 * m2 > 0.0)) return 0.0;
    const double w1 = 2.0 * h2 + h1, w2 = h2 + 2.0 * h1;
    return (w1 + w2) / (w1 / m1 + w2 / m2);
  }
  const std::size_t near = i == 0 ? 0 : last - 1, far = i == 0 ? 1 : last - 2;
  const double h1 = width(near), h2 = width(far), m1 = slope(near), m2 = slope(far);
  const double d = ((2.0 * h1 + h2) * m1 - h1 * m2) / (h1 + h2);
  if (!(d * m1 > 0.0)) return 0.0;
  if (m1 * m2 <= 0.0 && std::abs(d) > 3.0 * std::abs(m1)) return 3.0 * m1;
  return d;
}

/// Value at the place `at` of a function that is known at ascending places; constant beyond them.
/// @param x  places, one at least
/// @param y  values there
inline double interpolated(std::span<const double> x, std::span<const double> y, double at,
                           Interpolation how) {
  const Neighborhood n = neighborhood(x, at, how);
  const std::size_t i = n.below;
  if (n.is_beyond) return y[i];
  const double h = x[i + 1] - x[i];
  const double s = (at - x[i]) / h;
  if (how == Interpolation::linear) return (1.0 - s) * y[i] + s * y[i + 1];
  const double before = pchip_slope(x, y, i), after = pchip_slope(x, y, i + 1);
  const double t = 1.0 - s;
  return t * t * (1.0 + 2.0 * s) * y[i] + s * s * (1.0 + 2.0 * t) * y[i + 1] +
         h * s * t * (t * before - s * after);
}

}  // namespace whirl::inline base
