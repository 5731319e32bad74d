#pragma once
/// Periodic orbits by shooting, on any flow map.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libdyn/system/contact_measures.hpp"

namespace whirl::inline dyn {

/// Result of a flow from one start.
struct FlowResult {
  Vec end;
  Mat tangent;                         ///< derivative of the end by the start
  std::vector<ContactTimes> contacts;  ///< empty: there are no contacts
  Failure failure;
};

/// Whether the derivative of the end is wanted, too.
enum class WithTangent { no, yes };

/// A map from the states at the start of a revolution to those some revolutions later.
struct Flow {
  Vec scale;            ///< of the states: what counts as one in each
  double period = 1.0;  ///< of a revolution [s]
  /// Moves several starts on by the same number of revolutions; one result for each start.
  std::function<std::vector<FlowResult>(std::span<const Vec> starts, long revolutions, WithTangent)>
      go;
  /// Revolutions after which the map is the same again. The period of an orbit and the length of a
  /// segment are multiples of this number.
  long repeats = 1;
};

struct ShootingOptions {
  int period = 1;           ///< of the orbit [revolutions]
  int segments = 0;         ///< a divisor of the period; 0: one for every Flow::repeats revolutions
  int most_steps = 12;      ///< of Newton's method
  double accurate = 1e-11;  ///< residual of an orbit [scales]

  /// @throws OptionError  if segments does not divide the period, or a number is not positive
  void check() const;
};

/// A periodic orbit, or how far the search for it got.
struct PeriodicOrbit {
  int period = 1;                 ///< [revolutions]
  double revolution = 1.0;        ///< duration of a revolution [s]
  std::vector<Vec> states;        ///< at the starts of the segments
  std::vector<Mat> tangents;      ///< of the segments, in scales
  double residual = 0.0;          ///< largest gap between segments [scales]
  std::vector<double> residuals;  ///< before every step of Newton's method, and after the last
  CVec multipliers;               ///< of the whole period, the largest first
  std::vector<ContactMeasure> contacts;  ///< shares of the period
  Failure failure;

  bool is_good() const { return !failure; }
  bool is_stable() const;
  /// log(multiplier) / period [1/s]; the imaginary part is known modulo the orbit's frequency.
  CVec exponents() const;
};

/// Finds a periodic orbit by multiple shooting with Newton's method.
///
///   flow(s_i) - s_(i+1) = 0,  i = 1 ... m,  s_(m+1) = s_1
///
/// A long orbit has several segments, so that errors of an unstable orbit do not grow over its
/// whole period. A step that makes the residual much larger is halved. The residual is below
/// options.accurate, or as small as rounding and events leave it, at most 1e-8.
///
/// @param start  near the orbit; the other segments start on the motion from there
/// @source [StoerBulirsch2002], 7.3.5
PeriodicOrbit find_orbit(const Flow& flow, const Vec& start, const ShootingOptions& options);

/// Finds a periodic orbit from the starts of all segments.
PeriodicOrbit find_orbit(const Flow& flow, std::vector<Vec> starts, const ShootingOptions& options);

/// Shortest period of an orbit by its segments, a divisor of its own period [revolutions].
int shortest_period(const PeriodicOrbit& orbit, const Vec& scale);

/// Moves all segments on once; the residual, the tangents and what contacts did go into the orbit.
/// @return  gaps flow(s_i) - s_(i+1) one after another [scales]; empty if the flow fails
Vec shoot(const Flow& flow, PeriodicOrbit& orbit, WithTangent wanted = WithTangent::yes);

/// Derivative of the gaps by the starts of the segments: A - I for a single segment.
Mat shooting_jacobian(std::span<const Mat> tangents);

}  // namespace whirl::inline dyn
