#include "libfe/eigen/newton.hpp"

#include <cmath>
#include <limits>

namespace whirl::inline fe {

namespace {

constexpr double rounding = 1e-8;  ///< of steps that grow again, as far as they are rounding
constexpr int most_steps = 25;

}  // namespace

PairNewton::PairNewton(const Sparse& M, const Sparse& D, const Sparse& K)
    : M_(M.cast<Complex>()),
      D_(D.cast<Complex>()),
      K_(K.cast<Complex>()),
      factor_(CSparse(M_ + D_ + K_)) {}

PairNewton::Step PairNewton::step(EigenPair& pair) {
  const CSparse Q = (pair.lambda * pair.lambda) * M_ + pair.lambda * D_ + K_;
  if (!factor_.factorize(Q)) return Step::is_exact;
  const CVec x = factor_.solve(CVec(2.0 * pair.lambda * (M_ * pair.q) + D_ * pair.q));
  const Complex change = pair.q.squaredNorm() / pair.q.dot(x);
  if (!x.allFinite() || !std::isfinite(std::abs(change))) return Step::failed;
  pair.lambda -= change;
  pair.q = x.normalized();
  return Step::taken;
}

bool PairNewton::converge(EigenPair& pair, double settled) {
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    const Complex before = pair.lambda;
    const Step done = step(pair);
    if (done != Step::taken) return done == Step::is_exact;
    const double size = std::abs(pair.lambda - before) / std::abs(pair.lambda);
    if (size <= settled || (size <= rounding && size >= 0.5 * last)) return true;
    last = size;
  }
  return false;
}

}  // namespace whirl::inline fe
