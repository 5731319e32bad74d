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
        Q_(K_) {}

  const CSparse& M() const { return M_; }
  const CSparse& D() const { return D_; }
  /// Q(lambda); valid until the next call.
  const CSparse& at(Complex lambda) {
    Q_.coeffs() = (lambda * lambda) * M_.coeffs() + lambda * D_.coeffs() + K_.coeffs();
    return Q_;
  }

 private:
  static CSparse on_pattern(double m, const Sparse& M, double d, const Sparse& D, double k,
                            const Sparse& K) {
    CSparse sum = (m * M + d * D + k * K).eval().cast<Complex>();
    sum.makeCompressed();
    return sum;
  }

  CSparse M_, D_, K_, Q_;
};

}  // namespace whirl::inline fe
