#pragma once
/// Dense decompositions by Eigen, compiled once: its templates take seconds in every file that
/// names them.

#include <memory>
#include <optional>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// P A = L U of a square Mat or CMat, with partial pivoting.
template <class Matrix>
class DenseLu {
 public:
  explicit DenseLu(const Matrix& A);
  ~DenseLu();
  DenseLu(DenseLu&&) noexcept;
  DenseLu& operator=(DenseLu&&) noexcept;

  /// A^-1 b, for one or several columns b.
  Matrix solve(const Eigen::Ref<const Matrix>& b) const;
  /// Estimate of 1 / (|A| |A^-1|): zero where A is singular.
  double rcond() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};
extern template class DenseLu<Mat>;
extern template class DenseLu<CMat>;

template <class Matrix>
struct SymmetricModes {
  Vec values;      ///< ascending
  Matrix vectors;  ///< a column for each; v* M v = 1
};
/// K v = lambda M v with self-adjoint K and M; nothing if M is not positive definite.
std::optional<SymmetricModes<Mat>> symmetric_modes(const Mat& K, const Mat& M);
std::optional<SymmetricModes<CMat>> hermitian_modes(const CMat& K, const CMat& M);
/// A v = lambda v with a self-adjoint A.
SymmetricModes<Mat> symmetric_modes(const Mat& A);
SymmetricModes<CMat> hermitian_modes(const CMat& A);

struct GeneralModes {
  CVec values;
  CMat vectors;  ///< a column for each, of length 1
};
/// A v = lambda v; nothing if the iteration does not converge, or A is empty or not finite.
std::optional<GeneralModes> general_modes(const Mat& A);

/// The x that comes nearest to A x = b, also where A is singular.
Vec least_squares(const Mat& A, const Vec& b);

/// Eigenvalues of a square matrix; NaN if the iteration does not converge.
CVec eigenvalues(const Mat& A);

struct SchurForm {
  Mat T;  ///< upper triangular but for blocks of two, whose eigenvalues are complex
  Mat U;  ///< orthogonal
};
/// A = U T U^T; nothing if the iteration does not converge, or A is empty or not finite.
std::optional<SchurForm> schur_form(const Mat& A);

}  // namespace whirl::inline base
