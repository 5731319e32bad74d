// The self-adjoint part of dense.hpp, apart so that neither takes the compiler too much memory.

#include <Eigen/Eigenvalues>

#include "libbase/dense.hpp"

namespace whirl {

namespace {

template <class Matrix>
std::optional<SymmetricModes<Matrix>> generalized(const Matrix& K, const Matrix& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, M);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return std::nullopt;
  return SymmetricModes<Matrix>{solver.eigenvalues(), solver.eigenvectors()};
}
template <class Matrix>
SymmetricModes<Matrix> standard(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

std::optional<SymmetricModes<Mat>> symmetric_modes(const Mat& K, const Mat& M) {
  return generalized(K, M);
}
std::optional<SymmetricModes<CMat>> hermitian_modes(const CMat& K, const CMat& M) {
  return generalized(K, M);
}
SymmetricModes<Mat> symmetric_modes(const Mat& A) {
  return standard(A);
}
SymmetricModes<CMat> hermitian_modes(const CMat& A) {
  return standard(A);
}

}  // namespace whirl
