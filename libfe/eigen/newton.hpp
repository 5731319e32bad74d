#pragma once

#include "libbase/numerics/linalg.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/eigen/pencil.hpp"

namespace whirl::inline fe {

/// An eigenpair of (lambda^2 M + lambda D + K) q = 0.
struct EigenPair {
  Complex lambda;
  CVec q;
};

/// Newton's iteration to an eigenpair that is near; the order of elimination is found once.
///
///   Q(s) x = (s M + D) q + M p,   lambda = s - q^H q / q^H x,   p = s x - q
///
/// with p = lambda q at first. Where s = lambda this is Newton's step. With the factors of an s
/// that is not much farther from the eigenvalue it is inverse iteration, which takes the next step
/// without a factorization.
///
/// @source [Ruhe1973]
class PairNewton {
 public:
  PairNewton(const Sparse& M, const Sparse& D, const Sparse& K);

  enum class Step { taken, is_exact, failed };

  /// One step. It is exact where Q is singular, and fails where it is not finite: the pair stays as
  /// it is.
  Step step(EigenPair& pair);

  /// Steps until one is relatively shorter than this, after which Newton's next one would be its
  /// square, or until as little is left by inverse iteration; false: it does not converge.
  bool converge(EigenPair& pair, double settled);

 private:
  bool iterate(EigenPair& pair, Complex s, double first, double left);

  Pencil pencil_;
  ComplexSparseLu factor_;
};

}  // namespace whirl::inline fe
