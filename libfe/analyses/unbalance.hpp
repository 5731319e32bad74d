#pragma once
/// Steady response to what has the frequency of the speed: unbalance, a bow of the shaft, forces of
/// order 1; and to forces of other orders and frequencies.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "libfe/assembly/excitations.hpp"

namespace whirl::inline fe {

/// Complex displacements at points over speeds: u(t) = Re(value e^(i Omega t)).
struct UnbalanceResponse {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<Point> points;
  CMat x, y;              ///< points x speeds [m]
  CMat theta_x, theta_y;  ///< likewise [rad]; empty: not kept; 0 of a body without tilts

  /// Those of a component, 0 to 3: x, y, theta_x, theta_y.
  const CMat& at(int component) const {
    return component == 0 ? x : component == 1 ? y : component == 2 ? theta_x : theta_y;
  }
};

/// Solves (K - Omega^2 M + i Omega (C + Omega G)) q = Omega^2 u + f at any speed, f that of forces
/// of order 1 and of the bow: displacements are those of the shaft's axis from the straight line,
/// bow and all.
class UnbalanceSolver {
 public:
  explicit UnbalanceSolver(const Assembler& assembler);
  /// For one load of any frequency in place of these, u(t) = Re(value e^(i w t)). Bearings take the
  /// coefficients of that frequency.
  UnbalanceSolver(const Assembler& assembler, const Excitation& load);
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

/// Calls a function at every speed with the number of the speed, the frequency w of a load there
/// [rad/s] and the complex amplitudes of the full vector, NaN where the dynamic stiffness is
/// singular. Bearings take the coefficients of that frequency.
void for_each_oscillation(
    const Assembler& assembler, const Excitation& load, const std::vector<double>& speeds,
    const std::function<void(Eigen::Index, double w, const CVec& full)>& take);

/// The same to one of the loads of other frequencies, of that frequency:
/// u(t) = Re(value e^(i w t)). Bearings take the coefficients of that frequency.
/// @return  x, y: NaN at speeds where the dynamic stiffness is singular
UnbalanceResponse oscillating_response(const Assembler& assembler, const Excitation& load,
                                       const std::vector<double>& speeds,
                                       const std::vector<Point>& points);

/// The response at given speeds.
///
/// @param points  where the response is wanted
/// @throws NumericalError  at a speed where the dynamic stiffness is singular
UnbalanceResponse unbalance_response(const Assembler& assembler, const std::vector<double>& speeds,
                                     const std::vector<Point>& points);

}  // namespace whirl::inline fe
