#include "libfe/assembly/states_apart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libbase/numerics/dense.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr double singular = 1e-14;   ///< of a reciprocal condition
constexpr double slow_share = 1e-6;  ///< of the fastest rate of the states

}  // namespace

Sparse unit_columns(int size, const std::vector<int>& numbers) {
  Sparse P(size, std::ssize(numbers));
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    P.insert(numbers[j], static_cast<int>(j)) = 1.0;
  }
  P.makeCompressed();
  return P;
}

Sparse block_of(const Sparse& left, const Sparse& A, const Sparse& right) {
  return left.transpose() * Sparse(A * right);
}

StatesApart::StatesApart(const DofMap& dofs) {
  if (dofs.states.empty()) return;
  std::vector<bool> is_state(static_cast<std::size_t>(dofs.full_size), false);
  for (const StateCoordinate& state : dofs.states) {
    is_state[static_cast<std::size_t>(state.index)] = true;
  }
  std::vector<int> of_structure, of_states;
  for (int j = 0; j < dofs.size(); ++j) {
    const Sparse::InnerIterator first(dofs.T, j);
    const bool is_one = first && is_state[static_cast<std::size_t>(first.row())];
    (is_one ? of_states : of_structure).push_back(j);
  }
  structure = unit_columns(dofs.size(), of_structure);
  states = unit_columns(dofs.size(), of_states);
}

Sparse stiffness_at_rest(const System& system, const StatesApart& parts) {
  const Sparse K = system.stiffness();
  if (!parts.has_states()) return K;
  const Sparse& P = parts.structure;
  const Sparse& E = parts.states;
  const Sparse K_s = block_of(P, K, P);
  Mat K_w(block_of(E, K, E));
  Sparse in = block_of(E, K, P), out = block_of(P, K, E);
  if (!(DenseLu<Mat>(K_w).rcond() > singular)) {
    const Mat C_w(block_of(E, system.C, E));
    const double s =
        slow_share * std::max(std::sqrt(K_w.cwiseAbs().maxCoeff()), C_w.cwiseAbs().maxCoeff());
    K_w += s * C_w + s * s * Mat::Identity(K_w.rows(), K_w.cols());
    in += s * block_of(E, system.C, P);
    out += s * block_of(P, system.C, E);
  }
  const Mat by_structure = DenseLu<Mat>(K_w).solve(Mat(in));
  return K_s - out * Sparse(by_structure.sparseView());
}

bool is_held_at_rest(const System& system) {
  return is_supported(symmetric_part(stiffness_at_rest(system, StatesApart(system.dofs))));
}

}  // namespace whirl::inline fe
