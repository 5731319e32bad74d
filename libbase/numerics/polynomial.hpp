#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

namespace whirl::inline base {

/// g(s) = c_0 + c_1 s + ... + c_degree s^degree on 0 <= s <= 1.
struct Polynomial {
  static constexpr int max_degree = 47;
  std::array<double, max_degree + 1> c{};
  int degree = 0;

  double operator()(double s) const {
    double value = c[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k) value = value * s + c[static_cast<std::size_t>(k)];
    return value;
  }
  double derivative(double s) const {
    double value = degree * c[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 1; --k) value = value * s + k * c[static_cast<std::size_t>(k)];
    return degree > 0 ? value : 0.0;
  }
  Polynomial operator-() const {
    Polynomial g{{}, degree};
    for (int k = 0; k <= degree; ++k)
      g.c[static_cast<std::size_t>(k)] = -c[static_cast<std::size_t>(k)];
    return g;
  }
};

/// First s in [0, 1] at which a polynomial falls below zero; nothing if it stays positive.
///
/// Conservative advancement: with M >= |g''| on [0, 1], g(s + u) >= g + g' u - M u^2 / 2, so s
/// moves by the positive root of the right side. No root can be jumped over, not even a double one,
/// and at a simple root the steps converge quadratically.
///
/// @param on_surface  g(0) is zero by definition (an event just happened there): its rounded
///                    value is taken off, and only a fall right at the start or a later one counts
/// @source ../docs/methods.md, "Events"
inline std::optional<double> first_downward_zero(Polynomial g, bool on_surface) {
  constexpr double zero = 1e-15;      // of g, which is made dimensionless by its owner
  constexpr double rounding = 1e-12;  // of coefficients that were interpolated
  constexpr double no_slope = 1e-10;  // of all coefficients: a slope below that is none, as where
                                      // sticking ends and the slip begins with zero rate
  constexpr int most_steps = 20'000;  // few, except at triple roots and where M is far above |g''|
  if (on_surface) g.c[0] = 0.0;
  if (g.c[0] < 0.0) return 0.0;

  double M = 0.0, third = 0.0, sum = std::abs(g.c[1]);
  for (int k = 2; k <= g.degree; ++k) {
    const double size = k * (k - 1) * std::abs(g.c[static_cast<std::size_t>(k)]);
    sum += std::abs(g.c[static_cast<std::size_t>(k)]);
    M += size;
    third += (k - 2) * size;
  }
  if (M == 0.0 && g.c[1] >= 0.0) return std::nullopt;  // a line that does not fall
  double s = 0.0;
  if (g.c[0] <= zero) {
    g.c[0] = 0.0;
    const double slope = g.c[1];
    const double bend = g.degree >= 2 ? g.c[2] : 0.0;
    if (std::abs(slope) > no_slope * sum + rounding) {
      if (slope < 0.0) return 0.0;
      s = M > 0.0 ? std::min(1.0, slope / M) : 1.0;  // g > 0 up to 2 slope / M
    } else {
      if (bend < -rounding) return 0.0;
      s = third > 0.0 ? std::min(1.0, 3.0 * bend / third) : 1.0;
      if (bend < rounding) return std::nullopt;  // stays on the surface
    }
  }
  for (int step = 0; step < most_steps && s < 1.0; ++step) {
    const double value = g(s), slope = g.derivative(s);
    if (value <= zero && slope < 0.0) return s;
    const double positive = std::max(value, 0.0);
    const double root = std::sqrt(slope * slope + 2.0 * M * positive);
    // the positive root of g + g' u - M u^2 / 2, without cancellation
    const double advance = slope < 0.0 ? 2.0 * positive / (root - slope) : (slope + root) / M;
    if (advance < 1e-15) return s;
    s += advance;
  }
  if (s >= 1.0) return g(1.0) < 0.0 ? std::optional(1.0) : std::nullopt;
  return s;
}

}  // namespace whirl::inline base
