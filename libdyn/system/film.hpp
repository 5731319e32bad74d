#pragma once
/// Oil films at a speed: where their journals are, and what the oil does to them.

#include <optional>
#include <string>

#include "libbase/numerics/linalg.hpp"
#include "libcontact/oil_film.hpp"
#include "libdyn/system/layout.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

/// An oil film at a speed. Velocities are told over the clearance and the rate of the phase.
struct FilmAtSpeed {
  Vec2 offset;
  double clearance;  ///< [m]
  double factor;     ///< of the force [N.s]
  double spin;       ///< that drags the oil, over the rate of the phase; 0: none
  double rate;       ///< of the phase [rad/s]
  AnyFilmLaw law;
};

/// What drags the oil of a film, the sum of the speeds of both walls [rad/s]. Two walls that turn
/// against each other at one speed drag none.
double drag_speed(const OilFilm& film, const Assembler& assembler, double Omega);

/// A film of a model at a speed [rad/s].
/// @param drag  as drag_speed() says [rad/s]
FilmAtSpeed at_speed(const OilFilm& film, double Omega, double drag);

/// An oil film in reduced coordinates eta.
struct ReducedFilm : FilmAtSpeed {
  std::string name;
  Eigen::Matrix<double, 2, Eigen::Dynamic> U;  ///< displacement from the bearing u = U eta [m]
  Eigen::Matrix<double, Eigen::Dynamic, 2> B;  ///< acceleration eta'' = B (force on the journal)
};

/// Eccentricity of the journal over the clearance; at 1 or more the journal is outside its bearing.
double eccentricity(const ReducedFilm& film, const double* y, StateLayout layout);

/// Force on the journal [N]; no number outside the bearing.
Vec2 film_force(const ReducedFilm& film, const double* y, StateLayout layout);

/// Force on a journal and its exact slopes.
struct FilmSlopes {
  Vec2 force;      ///< [N]
  Mat2 by_u;       ///< by the displacement [N/m]
  Mat2 by_u_rate;  ///< by the velocity [N.s/m]
};

/// What the oil does at a displacement from the bearing [m] and a velocity [m/s]; nothing outside.
std::optional<FilmSlopes> film_slopes(const FilmAtSpeed& film, const Vec2& u, const Vec2& u_rate);

/// Displacement from the bearing [m] at which the film alone carries a load [N]; nothing without
/// spin, or if that place is nearer to the wall than 1e-12 of the clearance.
std::optional<Vec2> place_under(const FilmAtSpeed& film, const Vec2& load);

}  // namespace whirl::inline dyn
