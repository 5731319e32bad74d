#pragma once
/// Sparse LU factors by KLU of SuiteSparse [DavisPalamadai2010].

#include <memory>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// P A Q = L U of a square sparse matrix.
class SparseLu {
 public:
  SparseLu();
  explicit SparseLu(const Sparse& A);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Whether A has an inverse; only then solve() has an answer.
  bool is_regular() const;
  /// A^-1 b, for one or several columns b; from one thread at a time.
  Mat solve(const Eigen::Ref<const Mat>& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// LU factors of complex matrices, one after the other, whose entries stand at the same places.
class ComplexSparseLu {
 public:
  /// Finds the order of elimination for matrices with entries at these places. The pattern must be
  /// compressed. Factors keep the order of pivots while it is stable, so that their last bits
  /// depend on the matrices before.
  explicit ComplexSparseLu(const CSparse& pattern);
  ~ComplexSparseLu();
  ComplexSparseLu(ComplexSparseLu&&) noexcept;
  ComplexSparseLu& operator=(ComplexSparseLu&&) noexcept;

  /// Whether A, on the pattern, has an inverse; only then solve() has an answer. A must stay where
  /// and as it is meanwhile.
  bool factorize(const CSparse& A);
  bool factorize(CSparse&& A) = delete;
  /// A^-1 b; from one thread at a time. The first solution of factors whose order of pivots is old
  /// is checked, and makes them anew where it is not accurate; NaN where there is no inverse then.
  CVec solve(const CVec& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace whirl::inline base
