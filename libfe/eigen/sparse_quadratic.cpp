#include <Spectra/GenEigsRealShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "libbase/error.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr int most_attempts = 5;  ///< each with room for the real eigenvalues of the one before
constexpr int most_failures = 3;  ///< to converge; each takes long, and further ones fail as well

/// Solves with a real sparse matrix: L D L^T where that is stable, L U otherwise.
class RealFactor {
 public:
  void compute(const Sparse& A, bool positive_definite) {
    uses_ldlt_ = positive_definite;
    if (uses_ldlt_) {
      ldlt_.compute(A);
    } else {
      lu_ = SparseLu(A);
    }
    if (uses_ldlt_ ? ldlt_.info() != Eigen::Success : !lu_.is_regular()) {
      throw NumericalError("the dynamic stiffness is singular at the shift of the eigensolver");
    }
  }
  Vec solve(const Vec& b) const { return uses_ldlt_ ? Vec(ldlt_.solve(b)) : Vec(lu_.solve(b)); }

 private:
  bool uses_ldlt_ = false;
  Eigen::SimplicialLDLT<Sparse> ldlt_;
  SparseLu lu_;
};

/// (A - s I)^-1 of the state (q, p = q' / scale), on second-order matrices.
struct StateInverse {
  using Scalar = double;
  const Sparse& M;
  const Sparse& D;
  const RealFactor& factor;
  double s, scale;

  Eigen::Index rows() const { return 2 * M.rows(); }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double) {}
  void perform_op(const double* in, double* out) const {
    const auto n = M.rows();
    const Eigen::Map<const Vec> q(in, n), p(in + n, n);
    Vec load = M * (scale * p + s * q);
    load.noalias() += D * q;
    const Vec x = factor.solve(load);
    Eigen::Map<Vec>(out, n) = -x;
    Eigen::Map<Vec>(out + n, n) = (q - s * x) / scale;
  }
};

/// Number of eigenvalues that converge; none where Spectra's iteration on its small matrix fails.
template <class Solver>
Eigen::Index converged_pairs(Solver& solver) {
  constexpr int restarts = 60;  // those that converge at all need ten or twenty
  try {
    return solver.compute(Spectra::SortRule::LargestMagn, restarts, 1e-11);
  } catch (const std::runtime_error&) {
    return 0;
  }
}

}  // namespace

struct QuadraticSolver::State {
  Sparse M, K;
  double shift = 0.0;
  double scale = 1.0;
  RealFactor factor;  // of K, if the shift is zero
};

QuadraticSolver::QuadraticSolver(Sparse M, Sparse K, double shift)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.M = std::move(M);
  s.K = std::move(K);
  s.shift = shift;
  if (shift != 0.0) {
    s.scale = std::abs(shift);
    return;
  }
  s.factor.compute(s.K, is_symmetric(s.K) && is_supported(s.K));
  // velocities are measured in the first frequency, found by inverse iteration
  Vec v = Vec::Ones(s.K.rows());
  for (int i = 0; i < 3; ++i) v = s.factor.solve(s.M * v).normalized();
  s.scale = std::sqrt(std::abs(v.dot(s.K * v) / v.dot(s.M * v)));
}

QuadraticSolver::~QuadraticSolver() = default;
QuadraticSolver::QuadraticSolver(QuadraticSolver&&) noexcept = default;
QuadraticSolver& QuadraticSolver::operator=(QuadraticSolver&&) noexcept = default;

QuadraticModes QuadraticSolver::lowest(const Sparse& D, int pairs) const {
  const State& s = *state_;
  const auto states = static_cast<int>(2 * s.M.rows());
  RealFactor shifted;
  const RealFactor* factor = &s.factor;
  if (s.shift != 0.0) {
    shifted.compute(Sparse(s.shift * s.shift * s.M + s.shift * D + s.K), false);
    factor = &shifted;
  }
  StateInverse op{s.M, D, *factor, s.shift, s.scale};
  int nev = std::min(2 * pairs + 2, states - 2);
  int failures = 0;
  for (int attempt = 0; attempt < most_attempts && failures < most_failures; ++attempt) {
    const int ncv = std::min(2 * nev + 6, states);
    Spectra::GenEigsRealShiftSolver<StateInverse> solver(op, nev, ncv, s.shift);
    solver.init();
    if (converged_pairs(solver) < nev) {
      ++failures;
      nev = std::min(nev + 4, states - 2);
      continue;
    }
    const CVec lambda = solver.eigenvalues();
    const CMat vectors = solver.eigenvectors();
    QuadraticModes modes{CVec(lambda.size()), CMat(s.M.rows(), lambda.size())};
    Eigen::Index kept = 0;
    int found = 0;
    for (Eigen::Index i = 0; i < lambda.size(); ++i) {
      if (lambda(i).imag() < 0.0) continue;
      found += lambda(i).imag() > 0.0 ? 1 : 0;
      modes.lambda(kept) = lambda(i);
      modes.q.col(kept++) = vectors.col(i).head(s.M.rows()).normalized();
    }
    if (found < pairs && nev < states - 2) {  // real eigenvalues took their places
      nev = std::min(nev + 2 * (pairs - found) + 2, states - 2);
      continue;
    }
    modes.lambda.conservativeResize(kept);
    modes.q.conservativeResize(s.M.rows(), kept);
    return modes;
  }
  throw NumericalError(
      fmt::format("the Arnoldi iteration did not find the lowest {} damped modes", pairs));
}

}  // namespace whirl::inline fe
