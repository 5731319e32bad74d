#pragma once
/// Oil films in reduced coordinates: where the journals are, and what the oil does to them.

#include <string>

#include "libbase/linalg.hpp"
#include "libcontact/oil_film.hpp"

namespace whirl::inline dyn {

/// An oil film in reduced coordinates eta.
struct ReducedFilm {
  std::string name;
  Eigen::Matrix<double, 2, Eigen::Dynamic> U;  ///< displacement from the bearing u = U eta [m]
  Eigen::Matrix<double, Eigen::Dynamic, 2> B;  ///< acceleration eta'' = B (force on the journal)
  Vec2 offset;
  double clearance;  ///< [m]
  double factor;     ///< of the force [N.s]
  double spin;       ///< Omega over the rate of the phase: 1, or 0 without spin
  double rate;       ///< of the phase [rad/s]
  AnyFilmLaw law;
};

/// Eccentricity of the journal over the clearance; the film is torn where it is 1 or more.
double eccentricity(const ReducedFilm& film, const double* y, int coordinates);

/// Force on the journal [N]; no number outside the bearing.
Vec2 film_force(const ReducedFilm& film, const double* y, int coordinates);

}  // namespace whirl::inline dyn
