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
///   Q(lambda) x = Q'(lambda) q,   lambda - q^H q / q^H x,   x / |x|
///
/// @source [Ruhe1973]
class PairNewton {
 public:
  PairNewton(const Sparse& M, const Sparse& D, const Sparse& K);

  enum class Step { taken, is_exact, failed };

  /// One step. It is exact where Q is singular, and fails where it is not finite: the pair stays as
  /// it is.
  Step step(EigenPair& pair);

  /// Steps until one is relatively shorter than this; false: it does not converge.
  bool converge(EigenPair& pair, double settled);

 private:
  Pencil pencil_;
  ComplexSparseLu factor_;
};

}  // namespace whirl::inline fe
