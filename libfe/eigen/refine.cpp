#include "libfe/eigen/refine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::inline fe {

namespace {

constexpr double accurate = 2e-11;  ///< backward error: a fifth of what is promised
constexpr int most_refinements = 3;
constexpr double unbalanced = 0.5;  ///< residual over the sum of its parts: 1 at infinity

double longest_column(const Sparse& A) {
  double longest = 0.0;
  for (int j = 0; j < A.outerSize(); ++j) longest = std::max(longest, A.col(j).norm());
  return longest;
}

}  // namespace

Refinement::Refinement(const Sparse& M, const Sparse& D, const Sparse& K)
    : M_(M),
      D_(D),
      K_(K),
      size_M_(longest_column(M)),
      size_D_(longest_column(D)),
      size_K_(longest_column(K)) {}

double Refinement::backward_error(Complex lambda, const CVec& q) const {
  const CVec residual = lambda * lambda * (M_ * q) + lambda * (D_ * q) + K_ * q;
  const double size = std::norm(lambda) * size_M_ + std::abs(lambda) * size_D_ + size_K_;
  return residual.norm() / (size * q.norm());
}

bool Refinement::balances(Complex lambda, const CVec& q) const {
  const CVec inertia = lambda * lambda * (M_ * q), damping = lambda * (D_ * q), elastic = K_ * q;
  return (inertia + damping + elastic).norm() <
         unbalanced * (inertia.norm() + damping.norm() + elastic.norm());
}

bool Refinement::is_infinite(Complex lambda, const CVec& q) const {
  const double size = std::abs(lambda);
  return size * size * size_M_ > size * size_D_ + size_K_ && !balances(lambda, q);
}

bool Refinement::improve(Complex& lambda, CVec& q, double reach) {
  double error = backward_error(lambda, q);
  const Complex start = lambda;
  for (int i = 0; i < most_refinements && error > accurate; ++i) {
    if (!newton_) newton_.emplace(M_, D_, K_);
    EigenPair next{lambda, q};
    if (newton_->step(next) != PairNewton::Step::taken) break;
    const double then = backward_error(next.lambda, next.q);
    if (!(then < error) || !(std::abs(next.lambda - start) < reach)) break;
    lambda = next.lambda;
    q = std::move(next.q);
    error = then;
  }
  return error <= accurate || balances(lambda, q);
}

}  // namespace whirl::inline fe
