#include "libbase/numerics/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense_complex.hpp"

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

namespace {

/// Of a real matrix, by complex arithmetic: a value that is no half of a pair is real.
std::optional<GeneralModes> in_pairs(std::optional<GeneralModes> modes) {
  constexpr double same = 1e-8;  // relative distance
  if (!modes) return modes;
  const CVec values = modes->values;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    bool is_half = false;
    for (Eigen::Index k = 0; k < values.size() && !is_half; ++k) {
      is_half = k != i && values(k).imag() * values(i).imag() < 0.0 &&
                std::abs(values(k) - std::conj(values(i))) <= same * std::abs(values(i));
    }
    if (!is_half) modes->values(i).imag(0.0);
  }
  return modes;
}

}  // namespace

std::optional<GeneralModes> general_modes(const Mat& A) {
  if (A.size() == 0 || !A.allFinite()) return std::nullopt;
  const Eigen::EigenSolver<Mat> solver(A);
  // iteration by pairs of real shifts may go in circles, where complex ones do not
  if (solver.info() != Eigen::Success) return in_pairs(general_modes(CMat(A.cast<Complex>())));
  return GeneralModes{solver.eigenvalues(), solver.eigenvectors()};
}

Vec least_squares(const Mat& A, const Vec& b) {
  return Eigen::ColPivHouseholderQR<Mat>(A).solve(b);
}

CVec eigenvalues(const Mat& A) {
  if (A.size() == 0) return {};
  const Eigen::EigenSolver<Mat> solver(A, false);
  if (solver.info() == Eigen::Success) return solver.eigenvalues();
  const auto found = general_modes(A);
  return found ? found->values : CVec::Constant(A.rows(), Complex(nan, nan));
}

std::optional<SchurForm> schur_form(const Mat& A) {
  if (A.size() == 0 || !A.allFinite()) return std::nullopt;
  const Eigen::RealSchur<Mat> form(A);
  if (form.info() != Eigen::Success) return std::nullopt;
  return SchurForm{form.matrixT(), form.matrixU()};
}

}  // namespace whirl::inline base
