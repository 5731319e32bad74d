#pragma once
/// Undamped critical speeds over the stiffness of the bearings.

#include <functional>
#include <string>
#include <vector>

#include "libfe/critical.hpp"
#include "libfe/shape_branches.hpp"

namespace whirl::inline fe {

struct CriticalMapOptions {
  CriticalOptions critical;  ///< count: of the stiffest bearings, all of which the map shows
  int steps_per_decade = 6;  ///< of stiffness, beside the steps that following modes takes
  double beyond = 1e2;       ///< from the softest stiffness over this to the stiffest times this
  /// Speeds whose stiffness of linearized connections, as oil films, says what the map goes over
  /// [rad/s]; empty: they are left out.
  std::vector<double> film_speeds{};
};

/// One critical speed along the map.
struct CriticalMapBranch {
  Whirl whirl = Whirl::planar;  ///< the sense it has at most stiffnesses
  std::vector<double> x;        ///< stiffness [N/m], or factor
  std::vector<double> speed;    ///< undamped [rad/s]
};

/// Stiffness of one or several like bearings in one direction.
struct StiffnessCurve {
  std::string name;  ///< "Kxx of left"
  /// At a speed [rad/s], [N/m]; NaN where an oil film has none.
  std::function<double(double Omega)> at;
};

/// Where the stiffness of the bearings over speed meets a critical speed.
struct StiffnessCrossing {
  std::size_t curve = 0, branch = 0;  ///< numbers in the map
  double stiffness = 0.0;             ///< [N/m]
  double speed = 0.0;                 ///< [rad/s]
};

struct CriticalMap {
  bool is_common = true;  ///< over a stiffness that all bearings have in all directions [N/m];
                          ///< else over a factor of them, where the model is at 1
  double top = 0.0;       ///< the map shows all critical speeds up to here [rad/s]
  std::vector<CriticalMapBranch> branches;  ///< ascending at the softest bearings
  std::vector<StiffnessCurve> curves;       ///< none over a factor
  std::vector<StiffnessCrossing> crossings;
  std::vector<ShapeGap> gaps;  ///< at: x where there are no critical speeds, and why
};

/// The critical speed map of a structure.
///
/// With bearings that are alike, or that change with speed, x is a stiffness that all of them have
/// in all directions, and their own stiffness goes on top, so that critical speeds are where these
/// cross [API684]. With bearings that differ, x is a factor of all of them. Rigid bearings stay as
/// they are, and so do seals with their stiffness at rest; damping is left out.
///
/// Linearized connections, as oil films, are bearings that change with speed.
///
/// Critical speeds are followed by their shapes. They rise with stiffness, no faster than its square
/// root, so that a branch leaves the map at its top only; where gyroscopics keep a mode from being
/// critical, it has no branch.
///
/// @return  no branches if no bearing has a stiffness
CriticalMap critical_map(const Structure& structure, const CriticalMapOptions& options);

}  // namespace whirl::inline fe
