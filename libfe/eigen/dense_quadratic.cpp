#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/eigen/quadratic.hpp"

namespace whirl::inline fe {

QuadraticModes dense_quadratic_modes(const Sparse& M, const Sparse& D, const Sparse& K,
                                     double shift) {
  const auto n = M.rows();
  if (n == 0) return {};
  const Mat mass(M), damping(D);
  const DenseLu<Mat> stiffness(shift * shift * mass + shift * damping + Mat(K));

  // velocities are measured in a frequency typical of the lowest modes
  double scale = std::abs(shift);
  if (scale == 0.0) {
    Vec v = Vec::Ones(n);
    for (int i = 0; i < 3; ++i) v = Vec(stiffness.solve(mass * v)).normalized();
    scale = std::sqrt(std::abs(v.dot(K * v) / v.dot(mass * v)));
    if (!std::isfinite(scale) || scale == 0.0) scale = 1.0;
  }
  Mat inverse(2 * n, 2 * n);
  inverse.topLeftCorner(n, n) = -stiffness.solve(damping + shift * mass);
  inverse.topRightCorner(n, n) = -scale * stiffness.solve(mass);
  inverse.bottomRows(n) = (shift / scale) * inverse.topRows(n);
  inverse.bottomLeftCorner(n, n).diagonal().array() += 1.0 / scale;

  const auto inverse_modes = general_modes(inverse);
  if (!inverse_modes) {
    throw NumericalError("the dense eigenvalue iteration of the damped system did not converge");
  }
  const CVec mu = inverse_modes->values;
  const CMat vectors = inverse_modes->vectors;
  const double infinite = 1e-14 * mu.cwiseAbs().maxCoeff();
  QuadraticModes modes{CVec(2 * n), CMat(n, 2 * n)};
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    if (std::abs(mu(i)) <= infinite) continue;
    const Complex lambda = shift + 1.0 / mu(i);
    if (lambda.imag() < 0.0) continue;
    modes.lambda(kept) = lambda;
    modes.q.col(kept++) = vectors.col(i).head(n).normalized();
  }
  modes.lambda.conservativeResize(kept);
  modes.q.conservativeResize(n, kept);
  return modes;
}

}  // namespace whirl::inline fe
