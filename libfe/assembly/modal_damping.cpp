#include "libfe/assembly/modal_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

/// A full matrix of this size is half a gigabyte.
constexpr Eigen::Index most_modally_damped = 8000;

/// The lowest modes at rest, so many that deform or all.
RealModes flexible_modes(const Sparse& K, const Sparse& M, int wanted) {
  const auto size = static_cast<int>(K.rows());
  for (int count = std::min(size, wanted);; count = std::min(size, 2 * count)) {
    RealModes modes = lowest_real_modes(K, M, count);
    const int flexible = static_cast<int>(modes.omega2.size()) - modes.rigid;
    if (flexible >= wanted || count >= size) return modes;
  }
}

Sparse matrix_of(const ModalDamping& how, const System& at_rest, const Sparse& M) {
  const int wanted = how.is_common ? most_damped_modes : static_cast<int>(how.ratios.size());
  const RealModes modes = flexible_modes(symmetric_part(at_rest.K), at_rest.M, wanted);
  const Mat momenta = M * Mat(at_rest.dofs.T * modes.Phi);
  const Eigen::Index end = std::min<Eigen::Index>(modes.omega2.size(), modes.rigid + wanted);
  Mat C = Mat::Zero(momenta.rows(), momenta.rows());
  for (Eigen::Index k = modes.rigid; k < end; ++k) {
    const auto number = static_cast<std::size_t>(how.is_common ? 0 : k - modes.rigid);
    const double rate = 2.0 * how.ratios[number] * std::sqrt(std::max(0.0, modes.omega2(k)));
    C.noalias() += rate * momenta.col(k) * momenta.col(k).transpose();
  }
  return C.sparseView();
}

}  // namespace

Sparse modal_damping_matrix(const ModalDamping& how, const std::function<System()>& at_rest,
                            const Sparse& M) {
  if (M.rows() > most_modally_damped) {
    throw ModelError({}, "damping.modal",
                     fmt::format("modal damping makes a full matrix, which takes up to {} degrees "
                                 "of freedom; this model has {}: use rayleigh instead",
                                 most_modally_damped, M.rows()));
  }
  try {
    return matrix_of(how, at_rest(), M);
  } catch (const NumericalError& error) {
    throw ModelError(
        {}, "damping.modal",
        fmt::format("the modes at rest, which it is given for, cannot be had: {}", error.what()));
  }
}

}  // namespace whirl::inline fe
