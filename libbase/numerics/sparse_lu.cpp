#include "libbase/numerics/sparse_lu.hpp"

#include <Eigen/SparseLU>

#include "libbase/system/interruption.hpp"

namespace whirl::inline base {

struct SparseLu::Factors {
  Eigen::SparseLU<Sparse> lu;
};

SparseLu::SparseLu() = default;
SparseLu::SparseLu(const Sparse& A) : factors_(std::make_unique<Factors>()) {
  interruption_point();
  factors_->lu.compute(A);
}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::is_regular() const {
  return factors_ && factors_->lu.info() == Eigen::Success;
}
Mat SparseLu::solve(const Eigen::Ref<const Mat>& b) const {
  return factors_->lu.solve(b);
}

}  // namespace whirl::inline base
