#pragma once
/// A rotor at rest on its oil films and rolling bearings at a speed, and these as linear
/// connections about this equilibrium.

#include <memory>
#include <vector>

#include "libdyn/system/running_bearing.hpp"
#include "libdyn/system/running_film.hpp"
#include "libdyn/system/scene.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/parts/bearings.hpp"

namespace whirl::inline dyn {

struct Model;

/// A rotor carried by its films and rolling bearings, without unbalance, contacts and whirl.
struct RotorOnFilms {
  double Omega = 0.0;                   ///< [rad/s]
  System system;                        ///< coefficients of 0 Hz, without films, nothing condensed
  Vec q;                                ///< displacement in the coordinates of the system
  Vec load;                             ///< full vector of the loads and the films' forces [N, N.m]
  std::vector<RunningFilm> films;       ///< those that are linearized, in the order of the model
  std::vector<RunningBearing> rolling;  ///< in the order of the model
};

/// Finds where the journals run.
///
///   (K + Omega H) q = f + sum_i U_i^T F_i(U_i q)
///
/// is solved in the displacements U_i q of the journals alone, those of inner rings among them: the
/// rotor between the journals is linear and acts on them as a load and a stiffness, which are found
/// once if the rotor does not depend on the speed (PortBalance).
class FilmEquilibrium {
 public:
  explicit FilmEquilibrium(const Model& model);
  ~FilmEquilibrium();

  /// Several threads may ask.
  /// @throws ModelError      if the rotor were free even with its journals held
  /// @throws NumericalError  if there is no equilibrium: without speed a film carries nothing
  std::shared_ptr<const RotorOnFilms> at(double Omega) const;

  /// Coefficients of the films at their equilibrium, one after the other, then of the rolling
  /// bearings; found once for each speed and kept, as many analyses ask again.
  const std::vector<BearingCoefficients>& coefficients(double Omega) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether any film of a model is linearized for linear analyses.
bool has_linear_films(const Model& model);

/// Whether linear analyses have forces about an equilibrium: films, or rolling bearings.
bool has_working_point(const Model& model);

/// The structure of a model for linear analyses: films and rolling bearings are connections, whose
/// coefficients at a speed are those at the place where the journal runs at this speed. Without
/// films this is the structure of the model.
Structure linear_structure(const Model& model);

/// The system of a scene as linear analyses have it: with films, if the model has any.
System linear_system(const Model& model, const Scene& scene);
/// The lowest modes of that system, each with the coefficients of its own frequency.
Modes linear_modes(const Model& model, const Scene& scene, int count);

}  // namespace whirl::inline dyn
