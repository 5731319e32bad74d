#pragma once
/// Closed motions of unknown period, of equations in which time does not occur.

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
  double revolution = 1.0;  ///< duration of a revolution, the unit of periods [s]
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
/// @param start, period  of a motion near the orbit
/// @source [Kuznetsov2004], 10.1.4
AutonomousOrbit find_autonomous_orbit(const AutonomousFlow& flow, const Vec& start, double period,
                                      int most_steps = 12);

/// Derivative of (gap, <f, dy>) by state and period, in scales.
/// @param tangent  of the flow over the period
/// @param start, end  rates f at the start and the end of the period
Mat autonomous_jacobian(const Mat& tangent, const Vec& start, const Vec& end);

/// The same orbit with its shortest period, a part of the given one.
AutonomousOrbit shorten(const AutonomousFlow& flow, const AutonomousOrbit& cycle);

/// The matrix that turns reduced states of a scene by an angle about the axis [rad].
/// @throws NumericalError  for a basis that is not closed under rotation
Mat rotation(const Scene& scene, double angle);

/// Start of a motion that reaches phase 0, where both frames are the same, after so many
/// revolutions; z is its state at the start as seen from the rotor.
/// @throws NumericalError  as rotation
MotionState rotating_start(const Scene& scene, const Vec& z, double revolutions);

/// What has order 1 stands still in the frame of the rotor, and nothing else.
inline constexpr std::array not_seen_from_the_rotor{Need::standstill, Need::other_orders,
                                                    Need::own_frequencies, Need::directions};
inline constexpr Abilities rotating_abilities{"the rotating frame", not_seen_from_the_rotor,
                                              "take the stationary frame"};

/// The flow of the rotor as seen from its own frame, where unbalance stands still: states are
/// turned back by the phase. Time does not occur in that frame if nothing but the unbalance tells
/// directions apart.
///
/// @throws NumericalError  for a system beyond rotating_abilities, or a basis that is not closed
///                         under rotation
AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, double tolerance = flow_tolerance);

/// The rotating flow of a scene at another value of a parameter, for states in the basis of a first
/// scene: see flow_of.
AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, const Scene& first,
                             double tolerance = flow_tolerance);

constexpr long most_recurrence = 64;  ///< revolutions within which a recurrence is looked for

/// Time after which a motion comes back near its start as seen from the rotor, a first guess of a
/// period [s]; nothing if the motion does not come near, or stands still.
std::optional<double> recurrence(const Scene& scene, const Vec& start, long revolutions);

}  // namespace whirl::inline dyn
