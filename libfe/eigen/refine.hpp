#pragma once

#include <optional>

#include "libbase/numerics/linalg.hpp"
#include "libfe/eigen/newton.hpp"

namespace whirl::inline fe {

/// Improves eigenpairs of (lambda^2 M + lambda D + K) q = 0 that miss the stated accuracy.
class Refinement {
 public:
  /// Keeps references to all three.
  Refinement(const Sparse& M, const Sparse& D, const Sparse& K);

  /// |(lambda^2 M + lambda D + K) q| / ((|lambda|^2 |M| + |lambda| |D| + |K|) |q|), with the
  /// longest column for the size of a matrix. [Tisseur2000]
  double backward_error(Complex lambda, const CVec& q) const;

  /// Newton's iteration, where the backward error is above 2e-11 and as long as it falls.
  ///
  /// @param reach  how far lambda may move: less than to another eigenvalue
  /// @return       whether it is an eigenpair: at an infinite eigenvalue (parts without mass,
  ///               M q = 0) that rounding made finite, nothing holds lambda^2 M q, and what is left
  ///               of the sum of the parts is as large as they are
  bool improve(Complex& lambda, CVec& q, double reach);

  /// Whether it is an infinite eigenvalue after all: so far out that a backward error says nothing,
  /// as lambda^2 |M| is larger than all else, and nothing holds what is left of its parts.
  bool is_infinite(Complex lambda, const CVec& q) const;

 private:
  /// Whether lambda^2 M q, lambda D q and K q hold one another at all.
  bool balances(Complex lambda, const CVec& q) const;

  const Sparse &M_, &D_, &K_;
  double size_M_, size_D_, size_K_;
  std::optional<PairNewton> newton_;  ///< once it is needed
};

}  // namespace whirl::inline fe
