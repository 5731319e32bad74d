#pragma once
/// A rotor at rest in its bearings, on its oil films and rolling bearings, at a speed.

#include <vector>

#include "libdyn/system/running_bearing.hpp"
#include "libdyn/system/running_film.hpp"
#include "libfe/analyses/static.hpp"

namespace whirl::inline dyn {

struct Model;

struct RestingRotor {
  StaticEquilibrium at_rest;
  std::vector<RunningFilm> films;  ///< those that are linearized
  std::vector<RunningBearing> rolling;

  /// Loads that bearings, then films, then rolling bearings carry; not those of seals.
  std::vector<BearingLoad> journal_loads(const Model& model) const;
};

/// The static equilibrium of a model at a speed [rad/s]; films carry as at that speed, contacts
/// with stators are left out.
/// @throws ModelError      as static_equilibrium
/// @throws NumericalError  as FilmEquilibrium::at
RestingRotor resting_rotor(const Model& model, const Assembler& assembler, double Omega);

}  // namespace whirl::inline dyn
