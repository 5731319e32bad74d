#pragma once
/// Damping ratios of modes as a matrix.

#include <functional>

#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

struct ModalDamping;

/// The damping that gives the modes at rest their ratios.
///
///   C = M Phi diag(2 zeta omega) Phi^T M,   K phi = omega^2 M phi,   Phi^T M Phi = I
///
/// Rigid-body modes get none. The matrix is full.
///
/// @param at_rest  gives the rotor at rest, without damping that matters
/// @param M        of the full vector, see DofMap
/// @return         of the full vector
/// @throws ModelError  where the modes cannot be computed, and for more degrees of freedom than a
///                     full matrix takes
Sparse modal_damping_matrix(const ModalDamping& how, const std::function<System()>& at_rest,
                            const Sparse& M);

}  // namespace whirl::inline fe
