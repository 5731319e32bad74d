#include "libbase/numerics/sparse_lu.hpp"

#include <klu.h>

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/system/interruption.hpp"

namespace whirl::inline base {

namespace {

/// KLU's functions for real numbers and for complex ones, which it takes as pairs of numbers.
template <class Scalar>
struct Klu {
  static constexpr auto factor = klu_factor;
  static constexpr auto refactor = klu_refactor;
  static constexpr auto growth = klu_rgrowth;
  static constexpr auto condition = klu_rcond;
  static constexpr auto solve = klu_solve;
  static constexpr auto free_numeric = klu_free_numeric;
};
template <>
struct Klu<Complex> {
  static constexpr auto factor = klu_z_factor;
  static constexpr auto refactor = klu_z_refactor;
  static constexpr auto growth = klu_z_rgrowth;
  static constexpr auto condition = klu_z_rcond;
  static constexpr auto solve = klu_z_solve;
  static constexpr auto free_numeric = klu_z_free_numeric;
};

/// Factors of matrices with entries at the same places, by KLU: made for matrices that hardly fill,
/// as those of chains of elements do.
template <class Scalar>
class KluFactors {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;

  explicit KluFactors(const Matrix& pattern)
      : columns_(pattern.outerIndexPtr(), pattern.outerIndexPtr() + pattern.cols() + 1),
        rows_(pattern.innerIndexPtr(), pattern.innerIndexPtr() + pattern.nonZeros()) {
    klu_defaults(&common_);
    common_.scale = -1;  // rows are taken as they are, and not looked over again
    symbolic_ =
        klu_analyze(static_cast<int>(pattern.cols()), columns_.data(), rows_.data(), &common_);
  }
  ~KluFactors() {
    forget();
    klu_free_symbolic(&symbolic_, &common_);
  }
  KluFactors(const KluFactors&) = delete;
  KluFactors& operator=(const KluFactors&) = delete;

  /// Whether A, on the pattern, has an inverse and is finite.
  bool factorize(const Matrix& A) {
    // the order of pivots of the last matrix serves, which takes half the time; the first solution
    // tells whether it is stable
    has_doubt_ = numeric_ && refactorize(values_of(A)) && has_pivots();
    return has_doubt_ || factorize_anew(A);
  }
  /// The same with an order of pivots of its own.
  bool factorize_anew(const Matrix& A) {
    double* values = values_of(A);
    has_doubt_ = false;
    for (const double least_pivot : {0.001, 1.0}) {  // of its column: the diagonal first, then any
      forget();
      if (!symbolic_) return false;
      common_.tol = least_pivot;
      numeric_ = Klu<Scalar>::factor(columns_.data(), rows_.data(), values, symbolic_, &common_);
      if (!numeric_ || is_stable(values)) break;
    }
    if (numeric_ && !has_pivots()) forget();
    return numeric_ != nullptr;
  }
  bool is_regular() const { return numeric_ != nullptr; }
  /// Whether nobody knows yet that the factors are stable; asked once.
  bool takes_doubt() { return std::exchange(has_doubt_, false); }

  /// Turns columns b into A^-1 b.
  template <class Columns>
  void solve(Columns& b) {
    assert(is_regular());
    Klu<Scalar>::solve(symbolic_, numeric_, static_cast<int>(b.rows()), static_cast<int>(b.cols()),
                       reinterpret_cast<double*>(b.data()), &common_);
  }

 private:
  static double* values_of(const Matrix& A) {
    return reinterpret_cast<double*>(const_cast<Scalar*>(A.valuePtr()));
  }
  bool refactorize(double* values) {
    return Klu<Scalar>::refactor(columns_.data(), rows_.data(), values, symbolic_, numeric_,
                                 &common_);
  }
  /// Whether all pivots are numbers other than zero. KLU tells a zero in a block of one row only by
  /// the condition.
  bool has_pivots() {
    return Klu<Scalar>::condition(symbolic_, numeric_, &common_) && common_.rcond > 0.0;
  }
  bool is_stable(double* values) {
    constexpr double least_growth = 1e-4;  // reciprocal: less than this lets rounding grow
    return has_pivots() &&
           Klu<Scalar>::growth(columns_.data(), rows_.data(), values, symbolic_, numeric_,
                               &common_) &&
           common_.rgrowth > least_growth;
  }
  void forget() {
    if (numeric_) Klu<Scalar>::free_numeric(&numeric_, &common_);
  }

  std::vector<int> columns_, rows_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  bool has_doubt_ = false;
};

}  // namespace

struct SparseLu::Factors : KluFactors<double> {
  using KluFactors::KluFactors;
};

SparseLu::SparseLu() = default;
SparseLu::SparseLu(const Sparse& A) {
  interruption_point();
  Sparse compressed = A;
  compressed.makeCompressed();
  factors_ = std::make_unique<Factors>(compressed);
  factors_->factorize(compressed);
}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::is_regular() const {
  return factors_ && factors_->is_regular();
}
Mat SparseLu::solve(const Eigen::Ref<const Mat>& b) const {
  Mat x = b;
  factors_->solve(x);
  return x;
}

struct ComplexSparseLu::Factors : KluFactors<Complex> {
  using KluFactors::KluFactors;

  /// Whether A x = b but for rounding.
  bool is_accurate(const CVec& x, const CVec& b) const {
    constexpr double enough = 1e-12;  // backward error; elimination that is stable leaves 1e-15
    const double size = std::sqrt(A->coeffs().abs2().sum() * x.squaredNorm()) + b.norm();
    return (b - *A * x).norm() <= enough * size;
  }

  const CSparse* A = nullptr;  ///< that is factored
};

ComplexSparseLu::ComplexSparseLu(const CSparse& pattern)
    : factors_(std::make_unique<Factors>(pattern)) {}
ComplexSparseLu::~ComplexSparseLu() = default;
ComplexSparseLu::ComplexSparseLu(ComplexSparseLu&&) noexcept = default;
ComplexSparseLu& ComplexSparseLu::operator=(ComplexSparseLu&&) noexcept = default;

bool ComplexSparseLu::factorize(const CSparse& A) {
  interruption_point();
  factors_->A = &A;
  return factors_->factorize(A);
}
CVec ComplexSparseLu::solve(const CVec& b) const {
  CVec x = b;
  factors_->solve(x);
  if (!factors_->takes_doubt() || factors_->is_accurate(x, b)) return x;
  if (!factors_->factorize_anew(*factors_->A)) return CVec::Constant(b.size(), Complex(nan, nan));
  x = b;
  factors_->solve(x);
  return x;
}

}  // namespace whirl::inline base
