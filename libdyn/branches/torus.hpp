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
/// The circle is given at 2 K + 1 even angles, as a trigonometric polynomial of degree K.
struct InvariantCircle {
  Mat points;                   ///< a state per column, at theta_j = 2 pi j / (2 K + 1)
  double rotation = 0.0;        ///< rho / (2 pi), in a period of the map, between 0 and 1
  int period = 1;               ///< of the map [revolutions]
  Eigen::Index coordinate = 0;  ///< whose first harmonic is real, where theta begins
  double residual = 0.0;        ///< [scales]
  double tail = 0.0;            ///< size of the highest harmonics over the largest
  /// Exponents of deviations across the circle, descending [1 / period]; stable if all are below 0.
  Vec exponents;
  double along = 0.0;  ///< exponent along the circle, zero but for errors
  Failure failure;

  bool is_good() const { return !failure; }
  bool is_stable() const { return is_good() && (exponents.size() == 0 || exponents(0) < 0.0); }
};

struct CircleOptions {
  int period = 1;           ///< of the map [revolutions]
  int harmonics = 16;       ///< K at first
  int most_harmonics = 64;  ///< K at most; K is doubled while the tail is too large
  double smooth = 1e-8;     ///< tail that is small enough
  int most_steps = 12;      ///< of Newton's method
};

/// First guess of a circle from the sections of a motion, one a period of the map: the frequency of
/// the strongest line, or a part of it whose harmonics leave much less, and the harmonics of that
/// frequency, by weighted averages.
///
/// @param sections  a state per column, 200 or more, without their transient
/// @return  nothing where the sections do not move
/// @source [Das2017]
std::optional<InvariantCircle> guessed_circle(const Mat& sections, const Vec& scale, int period,
                                              int harmonics);

/// Finds a circle near a guess by Newton's method for all its points and the rotation.
/// @source [Schilder2005]
InvariantCircle find_circle(const Flow& flow, const InvariantCircle& guess,
                            const CircleOptions& options);

/// Equations of a circle for the unknowns (points [scales], rotation), at fixed K. Theta begins
/// where the first harmonic of a coordinate is real.
///
/// Multipliers are exp(exponent) across the circle, over a period of the map. Where the tail
/// exceeds a hundredth the equations fail: the circle breaks up, or locks to a periodic orbit.
/// @param coordinate  whose first harmonic is real
BranchEquations circle_equations(FlowAt flow_at, Vec scale, int period, Eigen::Index coordinate);

/// Unknowns of circle_equations.
Vec circle_unknowns(const InvariantCircle& circle, const Vec& scale);

/// The circle of such unknowns, without exponents.
InvariantCircle circle_of(const Vec& unknowns, const Vec& scale, int period);

}  // namespace whirl::inline dyn
