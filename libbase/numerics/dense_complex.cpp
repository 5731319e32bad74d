#include "libbase/numerics/dense_complex.hpp"

#include <Eigen/Eigenvalues>

namespace whirl::inline base {

std::optional<GeneralModes> general_modes(const CMat& A) {
  if (!A.allFinite()) return std::nullopt;
  const Eigen::ComplexEigenSolver<CMat> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return GeneralModes{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace whirl::inline base
