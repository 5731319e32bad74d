#pragma once
/// Harmonic balance of a rotor with its contacts and films.

#include <vector>

#include "libdyn/orbits/harmonic_balance.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/number_slopes.hpp"

namespace whirl::inline dyn {

/// @param system  must live as long as the problem
/// @throws NumericalError  if nothing moves
/// @throws ModelError      for a system beyond orbit_abilities
HarmonicProblem harmonic_problem(const ContactSystem& system);

/// Derivative of the harmonic problem of a system by a parameter, in the form that
/// HarmonicEquations::slope takes.
/// @param system  its contacts, films and orders of loads count; may be in other coordinates
/// @param slopes  in the coordinates of the result
HarmonicProblem harmonic_slope(const ContactSystem& system, const NumberSlopes& slopes);

/// Fourier coefficients of the motion of all coordinates over the next revolutions, as if the
/// motion repeated.
/// @param y  state at phase 0
/// @return   n x (2 H + 1); after a failure of the integration, the displacements of y stand for
///           the rest
Mat harmonic_start(const ContactSystem& system, const Vec& y, int revolutions);

/// An orbit, and what the contacts do on it.
struct ContactOrbit {
  HarmonicOrbit orbit;
  std::vector<ContactMeasure> contacts;  ///< shares of the period
};

/// Finds a periodic orbit near the motion from a state. The search fails if a contact would stick
/// on the orbit, as the series knows sliding friction only.
ContactOrbit find_harmonic_orbit(const ContactSystem& system, const Vec& y,
                                 const HarmonicOptions& options);

}  // namespace whirl::inline dyn
