#include "libfe/eigen/hermitian.hpp"

#include <Spectra/MatOp/SparseCholesky.h>
#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymGEigsSolver.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline fe {

namespace {

constexpr int dense_hermitian_below = 150;
constexpr double dependent = 1e-6;  ///< share of a vector that is left when it repeats others

HermitianModes dense(const Sparse& M, const Sparse& G, double g, const Sparse& K, int count) {
  const Eigen::LLT<Mat> factor{Mat(K)};
  if (factor.info() != Eigen::Success)
    throw NumericalError("the stiffness is not positive definite");
  CMat B = M.cast<Complex>() - Complex(0.0, g) * G.cast<Complex>();
  const CMat L = Mat(factor.matrixL()).cast<Complex>();
  L.triangularView<Eigen::Lower>().solveInPlace(B);
  B.adjointInPlace();
  L.triangularView<Eigen::Lower>().solveInPlace(B);
  const SymmetricModes<CMat> modes = hermitian_modes(B);
  CMat q = modes.vectors.rowwise().reverse().leftCols(count);
  L.adjoint().triangularView<Eigen::Upper>().solveInPlace(q);
  return {modes.values.reverse().head(count), q};
}

}  // namespace

HermitianModes largest_hermitian(const Sparse& M, const Sparse& G, double g, const Sparse& K,
                                 int count) {
  const auto n = static_cast<int>(M.rows());
  count = std::min(count, n);
  if (n < dense_hermitian_below || 4 * count >= n) return dense(M, G, g, K, count);

  // q = a + i b:  [M gG; -gG M] (a, b) = nu [K 0; 0 K] (a, b), every eigenvalue twice
  std::vector<Triplet> left, right;
  const auto add = [](std::vector<Triplet>& to, const Sparse& A, int row, int column, double by) {
    for (int j = 0; j < A.outerSize(); ++j) {
      for (Sparse::InnerIterator it(A, j); it; ++it) {
        to.emplace_back(row + static_cast<int>(it.row()), column + j, by * it.value());
      }
    }
  };
  add(left, M, 0, 0, 1.0);
  add(left, M, n, n, 1.0);
  add(left, G, 0, n, g);
  add(left, G, n, 0, -g);
  add(right, K, 0, 0, 1.0);
  add(right, K, n, n, 1.0);
  Sparse A(2 * n, 2 * n), B(2 * n, 2 * n);
  A.setFromTriplets(left.begin(), left.end());
  B.setFromTriplets(right.begin(), right.end());

  Spectra::SparseSymMatProd<double> product(A);
  Spectra::SparseCholesky<double> factor(B);
  if (factor.info() != Spectra::CompInfo::Successful) {
    throw NumericalError("the stiffness is not positive definite");
  }
  const int nev = 2 * count + 4;
  Spectra::SymGEigsSolver<decltype(product), decltype(factor), Spectra::GEigsMode::Cholesky> solver(
      product, factor, nev, 2 * nev + 8);
  solver.init();
  if (solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-12) < nev) {
    throw NumericalError("Lanczos did not converge on the critical speeds");
  }
  const Vec nu = solver.eigenvalues();
  const Mat vectors = solver.eigenvectors();
  HermitianModes modes{Vec(count), CMat(n, count)};
  int kept = 0;
  for (Eigen::Index i = 0; i < nu.size() && kept < count; ++i) {
    CVec q = vectors.col(i).head(n).cast<Complex>() +
             Complex(0, 1) * vectors.col(i).tail(n).cast<Complex>();
    const double before = q.dot(CVec(K * q)).real();
    for (int j = 0; j < kept; ++j) q -= modes.q.col(j) * modes.q.col(j).dot(CVec(K * q));
    const double after = q.dot(CVec(K * q)).real();
    if (after < dependent * before) continue;
    modes.nu(kept) = nu(i);
    modes.q.col(kept++) = q / std::sqrt(after);
  }
  modes.nu.conservativeResize(kept);
  modes.q.conservativeResize(n, kept);
  return modes;
}

}  // namespace whirl::inline fe
