#pragma once
/// How far friction bends a blade, and how much it gets shorter.

#include "libbase/numerics/dense.hpp"
#include "libcontact/laws/blade_tip.hpp"

namespace whirl::inline contact {

/// A blade that a force of 1 N along the circumference bends at its tip:
/// y = sum_{p=2}^6 a_p (x / l)^p.
///
///   E I y'''' - Omega^2 ((T y')' + A rho y) = 0,   -E I y'''(l) = 1
///   T(x) = A rho int_x^l (R - l + s) ds
///
/// for a cantilever of length l whose tip is at R, stiffened by its centrifugal tension and
/// softened by what of the centrifugal force is along the circumference.
///
/// @source [Blevins1979], ch. 8; assumed modes by the potential energy of beam and tension
struct BentBlade {
  Vec a;                ///< [m/N]
  double slopes = 0.0;  ///< int_0^l y'^2 dx [m/N^2]
};
/// @param Omega  spin [rad/s]
inline BentBlade bent_blade(const BladeTip<>& blade, double Omega) {
  constexpr int terms = 5;
  const double l = blade.blade_length, root = blade.tip_radius - l;
  const double bending = blade.bending_stiffness / (l * l * l);
  const double tension = Omega * Omega * blade.line_density / l;
  const double softening = Omega * Omega * blade.line_density * l;
  Mat K(terms, terms), slopes(terms, terms);
  for (int i = 0; i < terms; ++i) {
    for (int j = 0; j < terms; ++j) {
      const double p = i + 2, q = j + 2, pq = p + q, product = p * q;
      const double of_root = root * l * (1.0 / (pq - 1.0) - 1.0 / pq);
      const double of_length = 0.5 * l * l * (1.0 / (pq - 1.0) - 1.0 / (pq + 1.0));
      K(i, j) = bending * product * (p - 1.0) * (q - 1.0) / (pq - 3.0) +
                tension * product * (of_root + of_length) - softening / (pq + 1.0);
      slopes(i, j) = product / (l * (pq - 1.0));
    }
  }
  const Mat a = DenseLu<Mat>(K).solve(Mat::Ones(terms, 1));
  return {a.col(0), a.col(0).dot(slopes * a.col(0))};
}

/// Radial shortening c_b of a blade per squared normal force at its tip [m/N^2].
///
///   c_b = 1/2 int_0^l y'^2 dx
///
/// for the tip's friction mu N; without rotation c_b = mu^2 l^5 / (15 (E I)^2).
///
/// @param mu     Coulomb coefficient
/// @param Omega  spin [rad/s]
inline double blade_shortening(const BladeTip<>& blade, double mu, double Omega) {
  return 0.5 * mu * mu * bent_blade(blade, Omega).slopes;
}

/// Motion of the tip along the circumference per friction force there [m/N]; without rotation
/// l^3 / (3 E I).
inline double blade_deflection(const BladeTip<>& blade, double Omega) {
  return bent_blade(blade, Omega).a.sum();
}

}  // namespace whirl::inline contact
