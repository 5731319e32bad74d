#pragma once

#include <memory>
#include <optional>

#include "libfe/eigen/equations_of_motion.hpp"

namespace whirl::inline fe {

/// Solves (K + Omega H - w^2 M + i w (C + Omega G)) q = f for many frequencies and speeds.
/// The speed of the equations does not count: each response has a speed of its own.
class DynamicStiffness {
 public:
  explicit DynamicStiffness(const EquationsOfMotion<Sparse>& equations);
  ~DynamicStiffness();
  DynamicStiffness(DynamicStiffness&&) noexcept;
  DynamicStiffness& operator=(DynamicStiffness&&) noexcept;

  /// @param w      frequency of the excitation [rad/s]
  /// @param Omega  spin speed [rad/s]
  /// @return       the response, or nothing where the matrix is singular
  std::optional<CVec> solve(double w, double Omega, const CVec& f);

  /// The same for several loads at one motion e^(lambda t), lambda = i w [rad/s]: whether the
  /// matrix is regular, and then responses.
  bool factorize(Complex lambda, double Omega);
  CVec solve(const CVec& f) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whirl::inline fe
