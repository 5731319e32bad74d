#pragma once
/// Functions of laws that are no sums, products or roots, for numbers that carry their derivatives.

#include "libbase/numerics/dual.hpp"
#include "libcontact/film.hpp"
#include "libcontact/laws/blade_tip.hpp"

namespace whirl::inline contact {

template <int N>
Dual<N> arc_cotangent(const Dual<N>& a) {
  return {arc_cotangent(a.value), -a.slopes / (1.0 + a.value * a.value)};
}

/// z of z + bend z^3 = d:  z' = (d' - z^3 bend') / (1 + 3 bend z^2).
template <int N>
Dual<N> indentation(const Dual<N>& d, const Dual<N>& bend) {
  const double z = indentation(d.value, bend.value), square = z * z;
  return {z, (d.slopes - square * z * bend.slopes) / (1.0 + 3.0 * bend.value * square)};
}
template <int N>
Dual<N> indentation(const Dual<N>& d, double bend) {
  return indentation(d, Dual<N>(bend));
}

}  // namespace whirl::inline contact
