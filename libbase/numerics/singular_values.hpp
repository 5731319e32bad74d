#pragma once
/// Singular values of dense matrices by Eigen, compiled once.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

struct LeftSingular {
  Vec values;   ///< descending
  Mat vectors;  ///< rows of A x values, orthonormal: the left ones
};
/// A = U diag(values) V^T, without V.
LeftSingular left_singular(const Mat& A);

/// A = Q R of a matrix with at least as many rows as columns: Q rows x columns, R upper triangular.
struct ThinQr {
  Mat Q, R;
};
ThinQr thin_qr(const Mat& A);

}  // namespace whirl::inline base
