#include "libfe/eigen/dynamic_stiffness.hpp"

#include "libbase/numerics/sparse_lu.hpp"

namespace whirl::inline fe {

/// All matrices on one common pattern: assembly at a frequency is one pass over values.
struct DynamicStiffness::State {
  CSparse A;
  Vec M, C, G, K, H;  // values of each matrix at the entries of A; H: empty where it is zero
  ComplexSparseLu solver;
};

namespace {

/// Values of B at the entries of a pattern that contains it.
Vec values_on(const Sparse& pattern, const Sparse& B) {
  const Sparse sum = 0.0 * pattern + B;  // same pattern, values of B
  return Eigen::Map<const Vec>(sum.valuePtr(), sum.nonZeros());
}

}  // namespace

DynamicStiffness::DynamicStiffness(const EquationsOfMotion<Sparse>& e) {
  const Sparse G = e.G(), H = e.H();
  Sparse pattern = e.K + e.M + e.C + G;
  if (e.circulates()) pattern = Sparse(pattern + H);
  pattern.makeCompressed();
  CSparse A = pattern.cast<Complex>();
  ComplexSparseLu solver(A);
  state_ = std::make_unique<State>(State{
      std::move(A), values_on(pattern, e.M), values_on(pattern, e.C), values_on(pattern, G),
      values_on(pattern, e.K), e.circulates() ? values_on(pattern, H) : Vec{}, std::move(solver)});
}

DynamicStiffness::~DynamicStiffness() = default;
DynamicStiffness::DynamicStiffness(DynamicStiffness&&) noexcept = default;
DynamicStiffness& DynamicStiffness::operator=(DynamicStiffness&&) noexcept = default;

bool DynamicStiffness::factorize(Complex lambda, double Omega) {
  State& s = *state_;
  Complex* value = s.A.valuePtr();
  const Complex square = lambda * lambda;
  for (Eigen::Index i = 0; i < s.K.size(); ++i) {
    value[i] = s.K(i) + square * s.M(i) + lambda * (s.C(i) + Omega * s.G(i));
  }
  for (Eigen::Index i = 0; i < s.H.size(); ++i) value[i] += Omega * s.H(i);
  return s.solver.factorize(s.A);
}

CVec DynamicStiffness::solve(const CVec& f) const {
  return state_->solver.solve(f);
}

std::optional<CVec> DynamicStiffness::solve(double w, double Omega, const CVec& f) {
  if (!factorize(Complex(0.0, w), Omega)) return std::nullopt;
  CVec q = solve(f);
  if (!q.allFinite()) return std::nullopt;
  return q;
}

}  // namespace whirl::inline fe
