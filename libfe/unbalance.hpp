#pragma once
/// Steady response to what turns with the shaft: unbalance, and a bow of it.

#include <memory>
#include <optional>
#include <vector>

#include "libfe/assemble.hpp"

namespace whirl::inline fe {

/// Complex displacements at points over speeds: u(t) = Re(value e^(i Omega t)).
struct UnbalanceResponse {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<Point> points;
  CMat x, y;  ///< points x speeds [m]
};

/// Solves (K - Omega^2 M + i Omega (C + Omega G)) q = Omega^2 u + f at any speed, f the force of the
/// bow: displacements are those of the shaft's axis from the straight line, bow and all.
class UnbalanceSolver {
 public:
  explicit UnbalanceSolver(const Assembler& assembler);
  ~UnbalanceSolver();

  /// Complex amplitudes of the full vector at a speed [rad/s], see DofMap [m, rad]; nothing where
  /// the dynamic stiffness is singular: the response is unbounded there.
  std::optional<CVec> at(double Omega);

  /// The same at some points only: x of all of them, then y [m].
  std::optional<CVec> at(double Omega, const std::vector<Point>& points);

  const DofMap& dofs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The response at given speeds.
///
/// @param points  where the response is wanted
/// @throws NumericalError  at a speed where the dynamic stiffness is singular
UnbalanceResponse unbalance_response(const Assembler& assembler, const std::vector<double>& speeds,
                                     const std::vector<Point>& points);

}  // namespace whirl::inline fe
