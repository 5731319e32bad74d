#include "libfe/eigen/newton.hpp"

#include <cmath>
#include <limits>

namespace whirl::inline fe {

namespace {

constexpr double rounding_steps = 1e-8;  ///< of steps that grow again, as far as they are rounding
constexpr int most_newton_steps = 25;

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

bool PairNewton::converge(EigenPair& pair, double settled) {
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_newton_steps; ++i) {
    const Complex before = pair.lambda;
    const Step done = step(pair);
    if (done != Step::taken) return done == Step::is_exact;
    const double size = std::abs(pair.lambda - before) / std::abs(pair.lambda);
    if (size <= settled || (size <= rounding_steps && size >= 0.5 * last)) return true;
    last = size;
  }
  return false;
}

}  // namespace whirl::inline fe
