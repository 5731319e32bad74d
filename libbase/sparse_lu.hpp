#pragma once
/// Sparse LU factors by Eigen, compiled once.

#include <memory>

#include "libbase/linalg.hpp"

namespace whirl {

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
  /// A^-1 b, for one or several columns b.
  Mat solve(const Eigen::Ref<const Mat>& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace whirl
