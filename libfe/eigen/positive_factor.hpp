#pragma once

#include <Eigen/SparseCholesky>
#include <memory>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Factors of a symmetric matrix, K = L D L^T.
using Ldlt = Eigen::SimplicialLDLT<Sparse>;
/// Factors of a matrix that is positive definite to rounding; null for another matrix.
std::unique_ptr<Ldlt> positive_factor(const Sparse& K);

}  // namespace whirl::inline fe
