#pragma once
/// Harmonic balance of a rotor with its contacts and films.

#include <vector>

#include "libdyn/orbits/harmonic_balance.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/number_slopes.hpp"

namespace whirl::inline dyn {

/// @param system  must live as long as the problem
/// @throws NumericalError  if nothing moves
/// @throws ModelError      as require_periodic_loads
HarmonicProblem harmonic_problem(const ContactSystem& system);

/// Its derivative by a parameter, as HarmonicEquations::slope takes it.
/// @param slopes  of systems in the same coordinates; of contacts and films the system may have
///                others
HarmonicProblem harmonic_slope(const ContactSystem& system, const NumberSlopes& slopes);

/// Fourier coefficients of the motion of all coordinates over the next revolutions, as if it
/// repeated.
/// @param y  state at phase 0
/// @return   n x (2 H + 1); the motion that the state stays at if the integration fails
Mat harmonic_start(const ContactSystem& system, const Vec& y, int revolutions);

/// An orbit, and what the contacts do on it.
struct ContactOrbit {
  HarmonicOrbit orbit;
  std::vector<ContactMeasure> contacts;  ///< shares of the period
};

/// Finds a periodic orbit near the motion from a state. It is none if a contact would stick on it,
/// which series of forces that slide cannot say.
ContactOrbit find_harmonic_orbit(const ContactSystem& system, const Vec& y,
                                 const HarmonicOptions& options);

}  // namespace whirl::inline dyn
