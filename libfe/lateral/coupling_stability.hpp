#pragma once
/// How much cross-coupled stiffness a rotor bears before it whirls by itself.

#include <optional>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/lateral/turning_shaft.hpp"

namespace whirl::inline fe {

/// A mode of the rotor with some cross-coupled stiffness.
struct CoupledMode {
  double coupling = 0.0;       ///< Q [N/m]
  double log_decrement = 0.0;  ///< stable above zero
  double frequency = 0.0;      ///< damped [rad/s]

  static constexpr auto columns() {
    return ColumnList{column("coupling", &CoupledMode::coupling, "N/m", "cross-coupled stiffness"),
                      column("log_decrement", &CoupledMode::log_decrement, "",
                             "of the least damped mode with it"),
                      column("frequency", &CoupledMode::frequency, "rad/s", "of that mode")};
  }
};

struct CouplingStability {
  std::vector<CoupledMode> modes;  ///< the least damped, ascending Q from 0; empty: none oscillates
  std::optional<CoupledMode>
      at_limit;  ///< Q_0, beyond which a mode grows; zero: one does without Q
  std::optional<CoupledMode> at_anticipated;  ///< the least damped mode at Q_A
};

struct CouplingOptions {
  double anticipated = 0.0;  ///< Q_A [N/m]
  int count = 8;             ///< modes looked at, at least; of small rotors all are
  int steps = 16;            ///< of the curve, from 0 to a quarter beyond Q_0
  TurningShaft shaft{};      ///< on which the station is
};

/// The least damped mode without any cross-coupled stiffness beside that of the structure, as
/// coupling_stability chooses it.
CoupledMode least_damped_mode(const Structure& structure, double Omega, const Station& at,
                              int count, const TurningShaft& shaft = {});

/// Logarithmic decrement over a cross-coupled stiffness at a station, at a speed.
///
///   f_x = -Q y,   f_y = Q x:   it feeds forward whirl
///
/// Every mode counts, whatever its sense of whirl without Q is called: with unlike bearings the one
/// that Q drives is often mixed or backward there. At each Q the decrement is the least one of the
/// modes that are no faster than the rotor spins, or than 1.5 times its slowest not backward one,
/// heavily damped ones as of oil films among them, and of every mode that grows, however fast it
/// is; minus infinity where the rotor leaves its place without oscillating. Q_0 is the least Q
/// beyond which an eigenvalue has a real part above zero, found along the imaginary axis, where
///
///   1 + (H_yx - H_xy) Q + det H(i w) Q^2 = 0,   H: receptance of the station at Q = 0, 2 x 2,
///
/// has a real root Q where i w is an eigenvalue, and is checked against eigenvalues along the
/// curve. Of rotors with 75 coordinates and more, modes are the lowest ones, so many that they
/// reach beyond the speed of the rotor. Coefficients of linearized connections, as oil films, are
/// those at Q = 0: Q acts on the whirl about the equilibrium and does not move the equilibrium
/// itself.
///
/// Of several shafts, Q drives the whirl in the sense in which the shaft of the station turns, the
/// speed of the rotor is that of this shaft, and modes count that move this shaft more than the
/// others; all of them turn.
///
/// @param Omega  speed of the first shaft [rad/s]
/// @source [API617], stability analysis of level I
CouplingStability coupling_stability(const Structure& structure, double Omega, const Station& at,
                                     const CouplingOptions& options);

}  // namespace whirl::inline fe
