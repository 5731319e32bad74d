#pragma once
/// The structure of a system beside the states of its supports.

#include <vector>

#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

/// Columns of the identity of a size, by their numbers.
Sparse unit_columns(int size, const std::vector<int>& numbers);

/// left^T A right.
Sparse block_of(const Sparse& left, const Sparse& A, const Sparse& right);

/// The coordinates of a system, sorted: q = structure * q_s + states * w. Empty where no support
/// has states.
struct StatesApart {
  Sparse structure;  ///< n x n_s, a column of the identity each
  Sparse states;     ///< n x k, likewise

  explicit StatesApart(const DofMap& dofs);
  bool has_states() const { return states.cols() > 0; }
};

/// Stiffness of the structure with its supports at rest, n_s x n_s: the states are what they become
/// under a constant displacement. Where a support never comes to rest, as an integrator does not,
/// it is what holds against a very slow growth.
Sparse stiffness_at_rest(const System& system, const StatesApart& parts);

/// Whether supports hold every freedom at rest: the symmetric part of that stiffness is positive
/// definite.
bool is_held_at_rest(const System& system);

}  // namespace whirl::inline fe
