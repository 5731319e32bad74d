#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// What one shaft adds to the equations of motion by its spin: ratio Omega (G q' + H q), and
/// ratio Omega' G q / 2 while the speed changes, see EquationsOfMotion::acceleration_stiffness.
template <class Matrix>
struct SpinPart {
  double ratio = 1.0;  ///< of the speed of this shaft to Omega
  Matrix G;            ///< gyroscopic, skew
  Matrix H;            ///< circulatory, skew, of damping that rotates with the shaft
};

/// Linear equations of motion: M q'' + (C + Omega G) q' + (K + Omega H) q = f. G and H are sums
/// over the shafts that spin, of the matrices of each shaft times the ratio of its speed.
///
/// M, C and K need not be symmetric where bearings are not; they may hold for the speed Omega
/// alone, see Assembler::tables_depend_on_speed.
template <class Matrix>
struct EquationsOfMotion {
  Matrix M, C, K;
  std::vector<SpinPart<Matrix>> spin_parts;
  double Omega = 0.0;  ///< the speed [rad/s]

  int size() const { return static_cast<int>(M.rows()); }
  Matrix G() const { return sum(&SpinPart<Matrix>::G); }
  Matrix H() const { return sum(&SpinPart<Matrix>::H); }
  /// Whether the H of some shaft is not zero: otherwise nothing that rotates damps.
  bool circulates() const {
    return std::ranges::any_of(spin_parts, [](const auto& s) { return s.H.squaredNorm() > 0.0; });
  }
  /// C + Omega G.
  Matrix D() const { return C + Omega * G(); }
  /// What goes with angular acceleration, Omega' times it beside the stiffness: G / 2, skew.
  ///
  /// Spin and tilt share the kinetic energy Omega q'^T G q / 2 where all sections turn by one
  /// angle. Lagrange's equations make Omega G q' + Omega' G q / 2 of it. This is the moment of a
  /// drive whose torque lies halfway between the axis at rest and the tilted one, as that of a
  /// homokinetic joint does.
  Matrix acceleration_stiffness() const { return 0.5 * G(); }
  /// K + Omega H.
  Matrix stiffness() const { return circulates() ? Matrix(K + Omega * H()) : K; }

  /// The same equations with f(A) for every matrix A.
  template <class F>
  auto mapped(const F& f) const {
    using Image = std::decay_t<decltype(f(M))>;
    EquationsOfMotion<Image> image{f(M), f(C), f(K), {}, Omega};
    for (const auto& s : spin_parts) image.spin_parts.push_back({s.ratio, f(s.G), f(s.H)});
    return image;
  }

 private:
  Matrix sum(Matrix SpinPart<Matrix>::*part) const {
    Matrix all(M.rows(), M.cols());
    all.setZero();
    for (const SpinPart<Matrix>& s : spin_parts) all += s.ratio * s.*part;
    return all;
  }
};

}  // namespace whirl::inline fe
