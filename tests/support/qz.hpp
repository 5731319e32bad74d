#pragma once
/// All eigenvalues of a quadratic eigenproblem by LAPACK's QZ iteration, independent of
/// libfe/eigen.

#include <Eigen/Core>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "libbase/numerics/linalg.hpp"

extern "C" void dggev_(const char* left, const char* right, const int* n, double* A, const int* lda,
                       double* B, const int* ldb, double* re, double* im, double* beta, double* vl,
                       const int* ldvl, double* vr, const int* ldvr, double* work, const int* lwork,
                       int* info);

namespace whirl::test {

struct Eigenpair {
  Complex lambda;
  CVec q;
};

/// Finite eigenpairs of (lambda^2 M + lambda D + K) q = 0 with Im lambda >= 0.
///
/// The pencil is scaled so that its three matrices have like sizes, lambda = gamma mu with
/// gamma^2 = |K| / |M|. [FanLinVanDooren2004]
inline std::vector<Eigenpair> qz_eigenpairs(const Mat& M, const Mat& D, const Mat& K) {
  const auto n = M.rows();
  const double gamma = std::sqrt(K.norm() / M.norm());
  const double delta = 2.0 / (K.norm() + gamma * D.norm());
  Mat A = Mat::Zero(2 * n, 2 * n), B = Mat::Identity(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -delta * K;
  A.bottomRightCorner(n, n) = -delta * gamma * D;
  B.bottomRightCorner(n, n) = delta * gamma * gamma * M;
  const int size = static_cast<int>(2 * n), lwork = 16 * size, one = 1;
  int info = 0;
  Vec re(size), im(size), beta(size), work(lwork);
  Mat vectors(size, size);
  double none = 0.0;
  dggev_("N", "V", &size, A.data(), &size, B.data(), &size, re.data(), im.data(), beta.data(),
         &none, &one, vectors.data(), &size, work.data(), &lwork, &info);
  std::vector<Eigenpair> pairs;
  if (info != 0) return pairs;
  for (int i = 0; i < size; ++i) {
    if (im(i) < 0.0 || std::abs(beta(i)) <= 1e-14 * std::hypot(re(i), im(i))) continue;
    CVec q = vectors.col(i).head(n).cast<Complex>();
    if (im(i) > 0.0) q += Complex(0, 1) * vectors.col(i + 1).head(n).cast<Complex>();
    pairs.push_back({gamma * Complex(re(i), im(i)) / beta(i), q.normalized()});
  }
  return pairs;
}

/// |(lambda^2 M + lambda D + K) q| / ((|lambda|^2 |M| + |lambda| |D| + |K|) |q|), with the largest
/// column for the norm of a matrix, which is no more than its 2-norm. [Tisseur2000]
inline double backward_error(const Sparse& M, const Sparse& D, const Sparse& K,
                             const Eigenpair& pair) {
  const auto size = [](const Sparse& A) {
    double largest = 0.0;
    for (int j = 0; j < A.outerSize(); ++j) largest = std::max(largest, Vec(A.col(j)).norm());
    return largest;
  };
  const Complex l = pair.lambda;
  const CVec residual = l * l * (M * pair.q) + l * (D * pair.q) + K * pair.q;
  return residual.norm() /
         ((std::norm(l) * size(M) + std::abs(l) * size(D) + size(K)) * pair.q.norm());
}

/// Newton's iteration on an eigenpair: QZ knows the lowest of a stiff rotor to a few digits only.
inline Eigenpair polished(const Sparse& M, const Sparse& D, const Sparse& K, Eigenpair pair) {
  const CVec v = pair.q;
  for (int i = 0; i < 6; ++i) {
    const Complex l = pair.lambda;
    const CSparse Q = l * l * M.cast<Complex>() + l * D.cast<Complex>() + K.cast<Complex>();
    Eigen::SparseLU<CSparse> factor(Q);
    if (factor.info() != Eigen::Success) break;  // l is an eigenvalue to the last digit
    const CVec x = factor.solve(CVec(2.0 * l * (M * pair.q) + D * pair.q));
    if (!x.allFinite()) break;
    const Complex change = v.dot(pair.q) / v.dot(x);
    pair = {l - change, x.normalized()};
    if (std::abs(change) < 1e-13 * std::abs(l)) break;
  }
  return pair;
}

}  // namespace whirl::test
