#include "libbase/numerics/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace whirl::inline base {

template <class Matrix>
struct DenseLu<Matrix>::Factors {
  Eigen::PartialPivLU<Matrix> lu;
};

template <class Matrix>
DenseLu<Matrix>::DenseLu(const Matrix& A)
    : factors_(std::make_unique<Factors>(Factors{Eigen::PartialPivLU<Matrix>(A)})) {}
template <class Matrix>
DenseLu<Matrix>::~DenseLu() = default;
template <class Matrix>
DenseLu<Matrix>::DenseLu(DenseLu&&) noexcept = default;
template <class Matrix>
DenseLu<Matrix>& DenseLu<Matrix>::operator=(DenseLu&&) noexcept = default;

template <class Matrix>
Matrix DenseLu<Matrix>::solve(const Eigen::Ref<const Matrix>& b) const {
  return factors_->lu.solve(b);
}
template <class Matrix>
double DenseLu<Matrix>::rcond() const {
  return factors_->lu.rcond();
}

template class DenseLu<Mat>;
template class DenseLu<CMat>;

std::optional<GeneralModes> general_modes(const Mat& A) {
  if (A.size() == 0 || !A.allFinite()) return std::nullopt;
  const Eigen::EigenSolver<Mat> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return GeneralModes{solver.eigenvalues(), solver.eigenvectors()};
}

Vec least_squares(const Mat& A, const Vec& b) {
  return Eigen::ColPivHouseholderQR<Mat>(A).solve(b);
}

CVec eigenvalues(const Mat& A) {
  return A.eigenvalues();
}

}  // namespace whirl::inline base
