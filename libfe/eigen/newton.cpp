#include "libfe/eigen/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::inline fe {

namespace {

constexpr double rounding_steps = 1e-8;  ///< of steps that grow again, as far as they are rounding
constexpr int most_newton_steps = 25;
constexpr int most_inverse_steps = 3;     ///< with the factors of one Newton step
constexpr double near_enough = 1e-4;      ///< a Newton step after which they may do, relative
constexpr double next_eigenvalue = 1e-2;  ///< relative distance that is expected at least

}  // namespace

PairNewton::PairNewton(const Sparse& M, const Sparse& D, const Sparse& K)
    : pencil_(M, D, K), factor_(pencil_.at(1.0)) {}

PairNewton::Step PairNewton::step(EigenPair& pair) {
  if (!factor_.factorize(pencil_.at(pair.lambda))) return Step::is_exact;
  const CVec x =
      factor_.solve(CVec(2.0 * pair.lambda * (pencil_.M() * pair.q) + pencil_.D() * pair.q));
  const Complex change = pair.q.squaredNorm() / pair.q.dot(x);
  if (!x.allFinite() || !std::isfinite(std::abs(change))) return Step::failed;
  pair.lambda -= change;
  pair.q = x.normalized();
  return Step::taken;
}

/// Inverse iteration with the factors at s of the last Newton step, until no more than `left` is
/// expected of the steps that follow; false: it does not get there soon, and the pair stays.
/// @param first  relative size of that step
bool PairNewton::iterate(EigenPair& pair, Complex s, double first, double left) {
  EigenPair next = pair;
  CVec p = next.lambda * next.q;
  double last = first;
  for (int i = 0; i < most_inverse_steps; ++i) {
    const CVec x = factor_.solve(CVec(pencil_.M() * CVec(p + s * next.q) + pencil_.D() * next.q));
    const Complex lambda = s - next.q.squaredNorm() / next.q.dot(x);
    const double length = x.norm();
    const double size = std::abs(lambda - next.lambda) / std::abs(lambda);
    if (!std::isfinite(size) || !(length > 0.0)) return false;
    p = (s * x - next.q) / length;
    next = {lambda, x / length};
    if (size * std::max(size / last, first / next_eigenvalue) <= left) {
      pair = std::move(next);
      return true;
    }
    last = size;
  }
  return false;
}

bool PairNewton::converge(EigenPair& pair, double settled) {
  const double left = std::max(settled * settled, std::numeric_limits<double>::epsilon());
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_newton_steps; ++i) {
    const Complex before = pair.lambda;
    const Step done = step(pair);
    if (done != Step::taken) return done == Step::is_exact;
    const double size = std::abs(pair.lambda - before) / std::abs(pair.lambda);
    if (size <= settled || (size <= rounding_steps && size >= 0.5 * last)) return true;
    if (size <= near_enough && iterate(pair, before, size, left)) return true;
    last = size;
  }
  return false;
}

}  // namespace whirl::inline fe
