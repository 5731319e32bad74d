// The complex part of sparse_lu.hpp, apart so that both are compiled at the same time.

#include <Eigen/SparseLU>

#include "libbase/numerics/sparse_lu.hpp"
#include "libbase/system/interruption.hpp"

namespace whirl::inline base {

struct ComplexSparseLu::Factors {
  Eigen::SparseLU<CSparse> lu;
};

ComplexSparseLu::ComplexSparseLu(const CSparse& pattern) : factors_(std::make_unique<Factors>()) {
  factors_->lu.analyzePattern(pattern);
}
ComplexSparseLu::~ComplexSparseLu() = default;
ComplexSparseLu::ComplexSparseLu(ComplexSparseLu&&) noexcept = default;
ComplexSparseLu& ComplexSparseLu::operator=(ComplexSparseLu&&) noexcept = default;

bool ComplexSparseLu::factorize(const CSparse& A) {
  interruption_point();
  factors_->lu.factorize(A);
  return factors_->lu.info() == Eigen::Success;
}
CVec ComplexSparseLu::solve(const CVec& b) const {
  return factors_->lu.solve(b);
}

}  // namespace whirl::inline base
