#pragma once
/// How much cross-coupled stiffness a rotor bears before it whirls by itself.

#include <optional>
#include <vector>

#include "libbase/column.hpp"
#include "libfe/modes.hpp"

namespace whirl::inline fe {

/// A mode of the rotor with some cross-coupled stiffness.
struct CoupledMode {
  double coupling = 0.0;       ///< Q [N/m]
  double log_decrement = 0.0;  ///< stable above zero
  double frequency = 0.0;      ///< damped [rad/s]

  static constexpr auto columns() {
    return ColumnList{column("coupling", &CoupledMode::coupling, "N/m", "cross-coupled stiffness"),
                      column("log_decrement", &CoupledMode::log_decrement, "",
                             "of the mode that it destabilizes"),
                      column("frequency", &CoupledMode::frequency, "rad/s", "of that mode")};
  }
};

struct CouplingStability {
  std::vector<CoupledMode> modes;             ///< ascending Q from 0; empty: no mode whirls forward
  std::optional<CoupledMode> at_limit;        ///< Q_0, where the logarithmic decrement is zero
  std::optional<CoupledMode> at_anticipated;  ///< the least damped mode at Q_A
};

struct CouplingOptions {
  double anticipated = 0.0;  ///< Q_A [N/m]
  int count = 8;             ///< modes looked at
  int steps = 32;            ///< of the curve, from 0 to a quarter beyond Q_0
};

/// Logarithmic decrement over a cross-coupled stiffness at a station, at a speed.
///
///   f_x = -Q y,   f_y = Q x:   it feeds forward whirl
///
/// Modes that whirl forward, or forward in parts, no faster than the rotor spins are followed by their
/// shapes from Q = 0; if there is none, the slowest forward one is. Heavily damped ones are followed
/// too, as those of oil films. The curve is that of the mode that loses its damping first, or, where
/// none does, of the least damped one up to where Q_0 is looked for: twenty times what the mass and the
/// damping of the mode alone would bear.
///
/// @param Omega  speed [rad/s]
/// @source [API617], stability analysis of level I
CouplingStability coupling_stability(const Structure& structure, double Omega, const Station& at,
                                     const CouplingOptions& options);

}  // namespace whirl::inline fe
