#include "libfe/eigen/dynamic_stiffness.hpp"

#include <Eigen/SparseLU>

namespace whirl {

/// The four matrices on one common pattern: assembly at a frequency is one pass over values.
struct DynamicStiffness::State {
  CSparse A;
  Vec M, C, G, K;  // values of each matrix at the entries of A
  Eigen::SparseLU<CSparse> solver;
};

namespace {

/// Values of B at the entries of a pattern that contains it.
Vec values_on(const Sparse& pattern, const Sparse& B) {
  const Sparse sum = 0.0 * pattern + B;  // same pattern, values of B
  return Eigen::Map<const Vec>(sum.valuePtr(), sum.nonZeros());
}

}  // namespace

DynamicStiffness::DynamicStiffness(const Sparse& M, const Sparse& C, const Sparse& G,
                                   const Sparse& K)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  Sparse pattern = K + M + C + G;
  pattern.makeCompressed();
  s.M = values_on(pattern, M);
  s.C = values_on(pattern, C);
  s.G = values_on(pattern, G);
  s.K = values_on(pattern, K);
  s.A = pattern.cast<Complex>();
  s.solver.analyzePattern(s.A);
}

DynamicStiffness::~DynamicStiffness() = default;
DynamicStiffness::DynamicStiffness(DynamicStiffness&&) noexcept = default;
DynamicStiffness& DynamicStiffness::operator=(DynamicStiffness&&) noexcept = default;

std::optional<CVec> DynamicStiffness::solve(double w, double Omega, const CVec& f) {
  State& s = *state_;
  Complex* value = s.A.valuePtr();
  for (Eigen::Index i = 0; i < s.K.size(); ++i) {
    value[i] = {s.K(i) - w * w * s.M(i), w * (s.C(i) + Omega * s.G(i))};
  }
  s.solver.factorize(s.A);
  if (s.solver.info() != Eigen::Success) return std::nullopt;
  CVec q = s.solver.solve(f);
  if (!q.allFinite()) return std::nullopt;
  return q;
}

}  // namespace whirl
