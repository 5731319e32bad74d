#pragma once
/// Polynomials on [0, 1] in Legendre's basis P_k(2 s - 1).

#include "libbase/numerics/linalg.hpp"
#include "libbase/numerics/quadrature.hpp"

namespace whirl::inline base {

/// P_0 ... P_(terms-1) at -1 <= x <= 1.
Vec legendre_at(double x, int terms);
/// The same at x = 2 s - 1, 0 <= s <= 1.
Vec legendre(double s, int terms);

/// Coefficients on [from, to] of a polynomial that is given by its coefficients on [0, 1].
/// @param rule  with as many points as the polynomial has terms
Mat restriction(double from, double to, const GaussRule& rule);

/// Entry (k, j) is the coefficient of s^k in P_j(2 s - 1).
Mat legendre_to_powers(int terms);

/// Maps values at the given nodes on [0, 1] to Legendre coefficients. Coefficients of powers follow
/// from those coefficients by legendre_to_powers; the product of both matrices would magnify the
/// rounding of values.
Mat values_to_legendre(const Vec& nodes);

/// Chebyshev points on [0, 1], both ends included.
Vec chebyshev_points(int points);

}  // namespace whirl::inline base
