// The self-adjoint part of dense.hpp, apart so that neither takes the compiler too much memory.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

namespace {

/// K x = lambda M x as C y = lambda y with C = L^-1 K L^-H, M = L L^H, x = L^-H y: the operations
/// of Eigen's GeneralizedSelfAdjointEigenSolver, which compiles its other two problems with this
/// one.
template <class Matrix>
std::optional<SymmetricModes<Matrix>> generalized(const Matrix& K, const Matrix& M) {
  const Eigen::LLT<Matrix> cholesky(M);
  Matrix C = K.template selfadjointView<Eigen::Lower>();
  cholesky.matrixL().template solveInPlace<Eigen::OnTheLeft>(C);
  cholesky.matrixU().template solveInPlace<Eigen::OnTheRight>(C);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(C);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return std::nullopt;
  Matrix vectors = solver.eigenvectors();
  cholesky.matrixU().solveInPlace(vectors);
  return SymmetricModes<Matrix>{solver.eigenvalues(), std::move(vectors)};
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

}  // namespace whirl::inline base
