#pragma once
/// A quasi-periodic motion as an invariant circle, and that circle along a parameter.

#include <functional>
#include <optional>
#include <vector>

#include "libdyn/branches/torus.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/parameter_range.hpp"

namespace whirl::inline dyn {

struct TorusOptions {
  CircleOptions circle{};
  long sections = 1000;                   ///< of the motion, from which the circle is guessed
  std::optional<ParameterRange> along{};  ///< nothing: a single circle
  int most_points = 200;                  ///< circles of a walk
};

/// A circle at a value of the parameter.
struct CirclePoint {
  double value = 0.0;     ///< of the parameter
  double rotation = 0.0;  ///< turns per revolution
  double growth = 0.0;  ///< largest exponent across the circle, per revolution; NaN: there is none
  double tail = 0.0;    ///< size of the highest harmonics over the largest
};

/// One way along the parameter.
struct CircleWalk {
  /// What the walk goes on from. Unknowns of the points between the first and the last one do not
  /// count, and are not there if the branch was read from a file.
  Branch branch;
  std::vector<CirclePoint> points;  ///< one for each of the branch
};

struct TorusBranch {
  InvariantCircle circle;         ///< at the first value
  double motion_rotation = 0.0;   ///< rotation of the motion, turns per period of the map
  std::vector<CircleWalk> walks;  ///< those of ParameterRange::directions that were begun
  bool is_complete = false;       ///< nothing is left to be walked

  /// All circles from one end of both walks to the other; the first value counts once.
  std::vector<CirclePoint> points() const;
};

/// The circle that a motion moves on; circle.is_good() says whether there is one.
///
/// @param start  of the motion, without its transient, at phase 0
/// @param stops  asked often; true: the search ends, and the circle has no points unless it was
///               found
/// @throws NumericalError  if the motion fails or settles on a periodic orbit
TorusBranch find_torus(
    const Scene& scene, const MotionState& start, const TorusOptions& options,
    const std::function<bool()>& stops = [] { return false; });

/// Walks along the parameter until the circle locks or breaks, or the range ends.
///
/// @param torus  with a good circle; walks that are there go on, bit by bit
/// @param scale  of the states
/// @param monitor  told the number of circles of a walk
TorusBranch follow_torus(const FlowAt& flow_at, const Vec& scale, TorusBranch torus,
                         const TorusOptions& options, const Monitor<TorusBranch>& monitor);

/// Finds a circle and follows it along the parameter.
///
/// @param scenes   the first one that of the circle; others are asked for along the parameter only
/// @param torus    what there is already; without points: nothing
/// @param settled  a motion on the circle, asked where there is none yet; nothing: stop
TorusBranch grow_torus(const ParameterScenes& scenes, TorusBranch torus,
                       const std::function<std::optional<MotionState>()>& settled,
                       const TorusOptions& options, const Monitor<TorusBranch>& monitor);

}  // namespace whirl::inline dyn
