#pragma once
/// Closed motions whose period is not known: of equations in which time does not occur.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/shooting.hpp"

namespace whirl::inline dyn {

/// The flow of an equation y' = f(y).
struct AutonomousFlow {
  struct Result {
    Vec end;
    Mat tangent;                           ///< derivative of the end by the start
    std::vector<ContactMeasure> contacts;  ///< shares of the time
    Failure failure;
  };
  Vec scale;                ///< of the states
  double revolution = 1.0;  ///< in which periods are told [s]
  std::function<Result(const Vec& y, double time, WithTangent wanted)> go;  ///< time > 0 [s]
  std::function<Vec(const Vec& y)> rate;                                    ///< f(y) [1/s]
};

struct AutonomousOrbit {
  Vec state;
  double period = 0.0;  ///< [s]
  double residual = 0.0;
  std::vector<double> residuals;  ///< before every step of Newton's method, and after the last
  CVec multipliers;               ///< the largest first, without the one that is 1 along the motion
  std::vector<ContactMeasure> contacts;  ///< shares of the period
  Failure failure;

  bool is_good() const { return !failure; }
  bool is_stable() const { return is_good() && multipliers.cwiseAbs().maxCoeff() < 1.0; }
};

/// Finds a closed motion by Newton's method on state and period, moving across the flow only:
///
///   flow(y, T) - y = 0,   <f(y), dy> = 0
///
/// @param start, period  near it
/// @source [Kuznetsov2004], 10.1.4
AutonomousOrbit find_autonomous_orbit(const AutonomousFlow& flow, const Vec& start, double period,
                                      int most_steps = 12);

/// Derivative of (gap, <f, dy>) by state and period, in scales.
/// @param tangent  of the flow over the period
/// @param start, end  rates there
Mat autonomous_jacobian(const Mat& tangent, const Vec& start, const Vec& end);

/// The same motion with the shortest period it has, a part of the given one.
AutonomousOrbit shorten(const AutonomousFlow& flow, const AutonomousOrbit& cycle);

/// What turns reduced states of a scene by an angle about the axis [rad].
/// @throws NumericalError  for a basis that is not closed under rotation
Mat rotation(const Scene& scene, double angle);

/// Where a motion begins that is z as seen from the rotor, so many revolutions before it comes to
/// phase 0, where both frames are the same.
/// @throws NumericalError  likewise
MotionState rotating_start(const Scene& scene, const Vec& z, double revolutions);

/// The rotor as it is seen from its own frame, where unbalance stands still: states are turned back
/// by the phase. Time does not occur there if nothing but the unbalance tells directions apart.
///
/// @throws NumericalError  for gravity, anisotropic bearings, contacts off the axis, or a basis
///                         that is not closed under rotation
AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, double tolerance = flow_tolerance);

/// The same of a scene at another value of a parameter, for the states of a first scene: see
/// flow_of.
AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, const Scene& first,
                             double tolerance = flow_tolerance);

constexpr long most_recurrence = 64;  ///< revolutions in which a motion is to come back

/// Time after which a motion from a start comes back to it nearest, as a first guess [s]; nothing
/// if it does not come near, or stands still.
std::optional<double> recurrence(const Scene& scene, const Vec& start, long revolutions);

}  // namespace whirl::inline dyn
