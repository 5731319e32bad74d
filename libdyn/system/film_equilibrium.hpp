#pragma once
/// A rotor at rest on its oil films at a speed, and its films as linear connections about that.

#include <memory>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libdyn/system/running_film.hpp"
#include "libdyn/system/scene.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

/// A rotor that its films carry, without unbalance, contacts and whirl.
struct RotorOnFilms {
  double Omega = 0.0;              ///< [rad/s]
  System system;                   ///< without films, nothing condensed
  Vec q;                           ///< displacement in its coordinates
  Vec load;                        ///< full vector of the loads and the films' forces [N, N.m]
  std::vector<RunningFilm> films;  ///< those that are linearized, as in the model
};

/// Finds where the journals run.
///
///   (K + Omega H) q = f + sum_i U_i^T F_i(U_i q)
///
/// is solved in the displacements U_i q of the journals alone: the rotor between them is linear,
/// and acts on them as a load and a stiffness, which are found once if they do not change with
/// speed (PortBalance).
class FilmEquilibrium {
 public:
  explicit FilmEquilibrium(const Model& model);
  ~FilmEquilibrium();

  /// Several threads may ask.
  /// @throws ModelError      if the rotor were free even with its journals held
  /// @throws NumericalError  if there is none: without speed a film carries nothing
  std::shared_ptr<const RotorOnFilms> at(double Omega) const;

  /// Coefficients of the films there, one after the other; found once for each speed and kept, as
  /// many analyses ask for them again.
  const std::vector<BearingCoefficients>& coefficients(double Omega) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether linear analyses know any film of a model.
bool has_linear_films(const Model& model);

/// The structure of a model for linear analyses: films are connections with the coefficients that
/// they have, at every speed, where their journals run then. Without films it is that of the model.
Structure linear_structure(const Model& model);

/// The system of a scene as linear analyses have it: with films, if the model has any.
System linear_system(const Model& model, const Scene& scene);
/// Its lowest modes, each with the coefficients of its own frequency.
Modes linear_modes(const Model& model, const Scene& scene, int count);

}  // namespace whirl::inline dyn
