#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Eigenpairs of (lambda^2 M + lambda D + K) q = 0 in a disc of the complex plane.
struct DiscModes {
  Complex center;       ///< [rad/s]
  double radius = 0.0;  ///< every eigenvalue nearer to the center than this is here [rad/s]
  CVec lambda;          ///< nearest to the center first [rad/s]
  CMat q;               ///< n x lambda.size(), columns of length one

  bool contains(Complex lambda_) const { return std::abs(lambda_ - center) <= radius; }
};

/// Finds all eigenpairs around points of the complex plane, by shift and invert.
///
///   x = -(s^2 M + s D + K)^-1 (M p + (s M + D) q),   v = s x + q
///
/// Arnoldi's method with two starting vectors, so that equal pairs of isotropic rotors are found;
/// when all is converged a fresh random vector joins, which brings to light what the first ones
/// missed. The disc ends before the first eigenvalue that is not converged. About a real center
/// everything is real, which takes a quarter of the time. Real eigenvalues that accumulate
/// elsewhere (at -1 / beta with damping beta K) are out of the way of a complex shift.
///
/// @source [TisseurMeerbergen2001], sec. 3.4; [Ruhe1979] for several starting vectors
class DiscSolver {
 public:
  static constexpr int largest_basis = 100;  ///< vectors; beyond, more discs cost less

  struct Growth {
    int most = largest_basis;  ///< vectors of the basis
    bool is_confirmed = true;  ///< a last fresh vector shows whether something was missed
  };

  /// Tells the radius that is wanted of a disc, from what is known of the disc so far: infinite
  /// while that cannot be said; nothing where the disc may stay as it is.
  ///
  /// @param radius  every eigenvalue nearer to the center is known [rad/s]
  /// @param lambda  these, nearest to the center first [rad/s]
  /// @param effort  size of the basis over `Growth::most`; above 1 while a last fresh vector is
  /// followed
  using WantedRadius = std::function<std::optional<double>(
      double radius, std::span<const Complex> lambda, double effort)>;

  DiscSolver(const Sparse& M, const Sparse& D, const Sparse& K);
  ~DiscSolver();
  DiscSolver(DiscSolver&&) noexcept;
  DiscSolver& operator=(DiscSolver&&) noexcept;

  /// The disc grows until it has this radius, or holds so many eigenvalues, or the basis is at its
  /// largest; its radius is then what was reached, zero if the matrix is singular at the center.
  DiscModes around(Complex center, double radius, int count) const {
    return around(center, radius, count, {});
  }
  DiscModes around(Complex center, double radius, int count, const Growth& growth) const;
  /// The same until it has the radius that is wanted.
  DiscModes around(Complex center, const WantedRadius& wanted) const {
    return around(center, wanted, {});
  }
  DiscModes around(Complex center, const WantedRadius& wanted, const Growth& growth) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whirl::inline fe
