#include "libfe/eigen/symmetric.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/eigen/positive_factor.hpp"

namespace whirl::inline fe {

namespace {

constexpr int dense_below = 120;       ///< dofs; dense is as fast there and never misses
constexpr double rigid_share = 1e-5;   ///< of the first flexible omega^2: a rigid-body mode
constexpr double pivot_noise = 1e-12;  ///< of the diagonal: a vanishing pivot

/// (K - sigma M)^-1 for Spectra, and the number of eigenvalues below sigma.
struct ShiftInvert {
  using Scalar = double;
  const Sparse& K;
  const Sparse& M;
  Ldlt factor;

  ShiftInvert(const Sparse& K_, const Sparse& M_) : K(K_), M(M_) {
    factor.analyzePattern(Sparse(K + M));
  }
  Eigen::Index rows() const { return K.rows(); }
  Eigen::Index cols() const { return K.cols(); }
  void set_shift(double sigma) {
    factor.factorize(Sparse(K - sigma * M));
    if (factor.info() != Eigen::Success) {
      throw NumericalError(fmt::format("K - s M cannot be factorized at s = {:g}", sigma));
    }
  }
  Eigen::Index below() const { return (factor.vectorD().array() < 0.0).count(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vec>(y, rows()) = factor.solve(Eigen::Map<const Vec>(x, rows()));
  }
};

RealModes dense_modes(const Sparse& K, const Sparse& M) {
  const auto modes = symmetric_modes(Mat(K), Mat(M));
  if (!modes) {
    throw NumericalError(
        "the mass matrix is not positive definite: some degrees of freedom lack inertia");
  }
  return {modes->values, modes->vectors, 0};
}

/// First flexible omega^2 of a free system, by subspace iteration from above.
double estimate_first_flexible(const Sparse& K, const Sparse& M) {
  const auto n = K.rows();
  const int block = static_cast<int>(std::min<Eigen::Index>(12, n));
  Vec diagonal = M.diagonal();
  double s = (K.diagonal().array() / diagonal.array()).minCoeff();
  Mat V = Mat::Random(n, block);
  double estimate = s;
  for (int it = 0; it < 40; ++it) {
    const Ldlt factor(Sparse(K + s * M));
    V = factor.solve(M * V);
    const auto ritz = symmetric_modes(V.transpose() * (K * V), V.transpose() * (M * V));
    if (!ritz) break;
    V = V * ritz->vectors;
    // the largest gap between neighbors separates rigid from flexible
    const Vec& theta = ritz->values;
    Eigen::Index first = 0;
    while (first + 1 < theta.size() &&
           std::abs(theta(first)) < rigid_share * theta(theta.size() - 1))
      ++first;
    const double previous = estimate;
    estimate = theta(first);
    if (std::abs(estimate - previous) < 0.1 * estimate && estimate > 0.05 * s) return estimate;
    s = std::max(0.3 * estimate, 1e-4 * s);
  }
  throw NumericalError("the first flexible mode of the free system was not found");
}

void orient(Mat& Phi) {
  for (Eigen::Index j = 0; j < Phi.cols(); ++j) {
    Eigen::Index largest = 0;
    Phi.col(j).cwiseAbs().maxCoeff(&largest);
    if (Phi(largest, j) < 0.0) Phi.col(j) *= -1.0;
  }
}

/// Marks the lowest modes as rigid where the system is free, and sets their frequency to zero.
void mark_rigid(RealModes& modes, double first_flexible) {
  while (modes.rigid < modes.omega2.size() &&
         std::abs(modes.omega2(modes.rigid)) < rigid_share * first_flexible) {
    modes.omega2(modes.rigid++) = 0.0;
  }
}

RealModes sparse_modes(const Sparse& K, const Sparse& M, int count, double sigma,
                       double first_flexible) {
  const auto n = static_cast<int>(K.rows());
  ShiftInvert op(K, M);
  const Spectra::SparseSymMatProd<double> product(M);
  int nev = std::min(count + 2 + count % 2, n - 1);
  for (int attempt = 0; attempt < 4; ++attempt, nev = std::min(2 * nev, n - 1)) {
    Spectra::SymGEigsShiftSolver<ShiftInvert, Spectra::SparseSymMatProd<double>,
                                 Spectra::GEigsMode::ShiftInvert>
        solver(op, const_cast<Spectra::SparseSymMatProd<double>&>(product), nev,
               std::min(2 * nev + 8, n), sigma);
    solver.init();
    if (solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-10) < nev) continue;
    RealModes modes{solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse(), 0};
    if (first_flexible > 0.0) mark_rigid(modes, first_flexible);

    // count eigenvalues below a gap after the last one wanted (never inside the rigid cluster)
    Eigen::Index kept = std::min<Eigen::Index>(count, modes.omega2.size() - 1);
    while (kept + 1 < modes.omega2.size() &&
           modes.omega2(kept) - modes.omega2(kept - 1) < 1e-6 * modes.omega2(kept)) {
      ++kept;
    }
    const double gap = modes.omega2(kept) - modes.omega2(kept - 1);
    if (gap < 1e-6 * modes.omega2(kept)) continue;  // a cluster is cut: ask for more
    op.set_shift(modes.omega2(kept) - 0.5 * gap);
    if (op.below() != kept) continue;
    modes.omega2.conservativeResize(count);
    modes.Phi.conservativeResize(n, count);
    modes.rigid = std::min(modes.rigid, count);
    return modes;
  }
  throw NumericalError(
      fmt::format("the lowest {} of {} undamped modes could not be proved complete", count, n));
}

}  // namespace

Sparse symmetric_part(const Sparse& A) {
  return 0.5 * (A + Sparse(A.transpose()));
}

bool is_symmetric(const Sparse& A) {
  const Sparse skew = A - Sparse(A.transpose());
  const auto largest = [](const Sparse& B) {
    return B.nonZeros() == 0 ? 0.0 : B.coeffs().abs().maxCoeff();
  };
  return largest(skew) <= 1e-12 * largest(A);
}

Sparse symmetric_inertia(const Sparse& M) {
  return is_symmetric(M) ? M : symmetric_part(M);
}

std::unique_ptr<Ldlt> positive_factor(const Sparse& K) {
  auto factor = std::make_unique<Ldlt>(K);
  if (factor->info() != Eigen::Success) return nullptr;
  const Vec diagonal = factor->permutationP() * Vec(K.diagonal());
  const Vec pivots = factor->vectorD();
  const bool is_positive = ((pivots.array() - pivot_noise * diagonal.array().abs()) > 0.0).all();
  return is_positive ? std::move(factor) : nullptr;
}

bool is_supported(const Sparse& K) {
  return K.rows() == 0 || positive_factor(K);
}

RealModes lowest_real_modes(const Sparse& K, const Sparse& M, int count) {
  const auto n = static_cast<int>(K.rows());
  count = std::min(count, n);
  if ((M.diagonal().array() <= 0.0).any()) {
    throw NumericalError(
        "the mass matrix is not positive definite: some degrees of freedom lack inertia");
  }
  const bool supported = is_supported(K);
  RealModes modes;
  if (n <= dense_below || 3 * count >= n) {
    modes = dense_modes(K, M);
    if (!supported) {
      // the largest step among the lowest seven separates at most six rigid modes from the rest
      const double scale = modes.omega2(std::min(n - 1, 12));
      Eigen::Index first = 0;
      while (first < n && std::abs(modes.omega2(first)) <= 1e-7 * scale) ++first;
      const bool all = first == n;  // nothing but free bodies
      mark_rigid(modes, all ? std::numeric_limits<double>::infinity() : modes.omega2(first));
    }
    modes.omega2.conservativeResize(count);
    modes.Phi.conservativeResize(n, count);
    modes.rigid = std::min(modes.rigid, count);
  } else if (supported) {
    modes = sparse_modes(K, M, count, 0.0, 0.0);
  } else {
    const double first = estimate_first_flexible(K, M);
    modes = sparse_modes(K, M, count, -0.09 * first, first);
  }
  orient(modes.Phi);
  return modes;
}

}  // namespace whirl::inline fe
