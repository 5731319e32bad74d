#pragma once
/// Quasi-periodic motion: invariant circles of the stroboscopic map.

#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/branches/branch_equations.hpp"

namespace whirl::inline dyn {

/// A circle x(theta) that the map P of some revolutions turns by a constant angle:
///
///   P(x(theta)) = x(theta + rho)
///
/// given at 2 K + 1 even angles, between which it is a trigonometric polynomial of degree K.
struct InvariantCircle {
  Mat points;                   ///< a state per column, at theta_j = 2 pi j / (2 K + 1)
  double rotation = 0.0;        ///< rho / (2 pi), in a period of the map, between 0 and 1
  int period = 1;               ///< of the map [revolutions]
  Eigen::Index coordinate = 0;  ///< whose first harmonic is real: where theta begins
  double residual = 0.0;        ///< [scales]
  double tail = 0.0;            ///< highest harmonics by the largest
  /// Exponents of its tangents across the circle, descending [1 / period]: all below 0 is stable.
  Vec exponents;
  double along = 0.0;  ///< that along it, which is zero but for errors
  Failure failure;

  bool is_good() const { return !failure; }
  bool is_stable() const { return is_good() && (exponents.size() == 0 || exponents(0) < 0.0); }
};

struct CircleOptions {
  int period = 1;           ///< of the map [revolutions]
  int harmonics = 16;       ///< K at first
  int most_harmonics = 64;  ///< K at most, doubled while the tail is too large
  double smooth = 1e-8;     ///< tail that is small enough
  int most_steps = 12;      ///< of Newton's method
};

/// First guess from the sections of a motion, every one a period of the map after the last: the
/// frequency of their strongest line, and harmonics of it, by weighted averages.
///
/// @param sections  a state per column, 200 or more, without their transient
/// @return  nothing where they do not move
/// @source [Das2017]
std::optional<InvariantCircle> guessed_circle(const Mat& sections, const Vec& scale, int period,
                                              int harmonics);

/// Finds a circle near a guess by Newton's method for all its points and the rotation.
/// @source [Schilder2005]
InvariantCircle find_circle(const Flow& flow, const InvariantCircle& guess,
                            const CircleOptions& options);

/// Equations of a circle for the unknowns (points [scales], rotation), at fixed K. What fixes where
/// theta begins: the first harmonic of a coordinate is real.
///
/// Their multipliers are the sizes of those across the circle, a period each. Where the tail
/// exceeds a hundredth the circle is no longer one: it breaks up, or locks to a periodic orbit.
/// @param coordinate  whose harmonic is real
BranchEquations circle_equations(FlowAt flow_at, Vec scale, int period, Eigen::Index coordinate);

/// Unknowns of those equations.
Vec circle_unknowns(const InvariantCircle& circle, const Vec& scale);

/// Circle of unknowns, without exponents.
InvariantCircle circle_of(const Vec& unknowns, const Vec& scale, int period);

}  // namespace whirl::inline dyn
