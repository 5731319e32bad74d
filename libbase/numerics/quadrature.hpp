#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Gauss-Legendre points on [0, 1] and weights, exact to degree 2 points - 1.
struct GaussRule {
  Vec s;  ///< ascending
  Vec w;  ///< sum 1
};
/// @source [AbramowitzStegun1964], 25.4.29; points by Newton's method
GaussRule gauss_rule(int points);

/// Gauss-Legendre points and weights, with the matrix that integrates from 0 to each point.
///
///   integral_0^1 f      = w . f(x),           exact for polynomials up to degree 2 n - 1
///   integral_0^{x_i} f  = (S f(x))_i,         exact for polynomials up to degree n - 1
///
/// @source Legendre series of the Lagrange polynomials; [Trefethen2013], ch. 17
struct Quadrature {
  Vec x;  ///< n points, ascending
  Vec w;  ///< n weights, sum 1
  Mat S;  ///< n x n

  /// @param n  number of points, n >= 1
  static Quadrature gauss(int n);

  /// Matrix from values at the points to values, at other places, of the polynomial through them.
  ///
  /// Barycentric formula; exact for polynomials up to degree n - 1.
  ///
  /// @param at  places, 0 to 1
  /// @return    places x n
  /// @source    [Trefethen2013], ch. 5
  Mat interpolation(const Vec& at) const;
};

}  // namespace whirl::inline base
