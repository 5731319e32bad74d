#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Q(lambda) = lambda^2 M + lambda D + K, with entries at the same places for every lambda.
class Pencil {
 public:
  Pencil(const Sparse& M, const Sparse& D, const Sparse& K)
      : M_(on_pattern(1.0, M, 0.0, D, 0.0, K)),
        D_(on_pattern(0.0, M, 1.0, D, 0.0, K)),
        K_(on_pattern(0.0, M, 0.0, D, 1.0, K)),
        Q_(K_.cast<Complex>()) {}

  const Sparse& M() const { return M_; }
  const Sparse& D() const { return D_; }
  /// Q(lambda); valid until the next call.
  const CSparse& at(Complex lambda) {
    const Complex square = lambda * lambda;
    const double *m = M_.valuePtr(), *d = D_.valuePtr(), *k = K_.valuePtr();
    Complex* q = Q_.valuePtr();
    for (Eigen::Index i = 0; i < Q_.nonZeros(); ++i) q[i] = square * m[i] + lambda * d[i] + k[i];
    return Q_;
  }

 private:
  static Sparse on_pattern(double m, const Sparse& M, double d, const Sparse& D, double k,
                           const Sparse& K) {
    Sparse sum = m * M + d * D + k * K;
    sum.makeCompressed();
    return sum;
  }

  Sparse M_, D_, K_;
  CSparse Q_;
};

}  // namespace whirl::inline fe
