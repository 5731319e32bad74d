#pragma once
/// Undamped critical speeds over the stiffness of the bearings.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/analyses/critical.hpp"

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
  std::vector<double> speed;    ///< at each x, undamped [rad/s]; NaN where it is none

  static constexpr auto columns() {
    using B = CriticalMapBranch;
    return ColumnList{
        column("whirl", &B::whirl, "", "sense of whirl"),
        column("speed", &B::speed, "rad/s", "undamped critical speed").along("stiffnesses")};
  }
};

/// Stiffness of one or several like bearings in one direction.
struct StiffnessCurve {
  std::string name;               ///< "Kxx of left"
  std::vector<double> stiffness;  ///< at each of the curves' speeds [N/m]; NaN: a film has none

  static constexpr auto columns() {
    using C = StiffnessCurve;
    return ColumnList{column("name", &C::name, "", "stiffness and bearings"),
                      column("stiffness", &C::stiffness, "N/m", "stiffness of the bearings")
                          .along("curve_speeds")};
  }
};

/// Where the stiffness of the bearings over speed meets a critical speed.
struct StiffnessCrossing {
  std::size_t curve = 0, branch = 0;  ///< numbers in the map
  double stiffness = 0.0;             ///< [N/m]
  double speed = 0.0;                 ///< [rad/s]

  static constexpr auto columns() {
    using C = StiffnessCrossing;
    return ColumnList{column("curve", &C::curve, "", "number of the stiffness curve")
                          .from_one()
                          .within(valid::numbers_of("stiffness_curves")),
                      column("branch", &C::branch, "", "number of the branch")
                          .from_one()
                          .within(valid::numbers_of("map_branches")),
                      column("stiffness", &C::stiffness, "N/m", "stiffness where they cross"),
                      column("speed", &C::speed, "rad/s", "critical speed where they cross")};
  }
};

/// A stiffness, or factor, at which there are no critical speeds to be had.
struct CriticalMapGap {
  double x = 0.0;
  std::string why;

  static constexpr auto columns() {
    return ColumnList{column("x", &CriticalMapGap::x, "", "stiffness that is left out"),
                      column("why", &CriticalMapGap::why, "", "why")};
  }
};

/// Group /critical_map.
struct CriticalMap {
  bool is_common = true;  ///< over a stiffness that all bearings have in all directions [N/m];
                          ///< else over a factor of them, where the model is at 1
  std::string swept;      ///< bearings and films whose stiffness that is, "left, right"
  double top = 0.0;       ///< the map shows all critical speeds up to here [rad/s]
  std::vector<double> x;  ///< stiffness [N/m], or factor; ascending
  std::vector<CriticalMapBranch> branches;  ///< ascending at the softest bearings
  std::vector<double> curve_speeds;         ///< of the curves [rad/s], ascending
  std::vector<StiffnessCurve> curves;       ///< none over a factor
  std::vector<StiffnessCrossing> crossings;
  std::vector<CriticalMapGap> gaps;

  static constexpr std::string_view group = "/critical_map";
  static constexpr auto columns() {
    using C = CriticalMap;
    return ColumnList{
        column("common", &C::is_common, "",
               "1: over a stiffness of all bearings [N/m]; 0: over a factor of their own")
            .within(valid::from_to(0.0, 1.0)),
        column("swept", &C::swept, "", "bearings and films whose stiffness that is").maybe(),
        column("top", &C::top, "rad/s", "all critical speeds up to here are known")
            .within(valid::positive),
        column("x", &C::x, "", "stiffness of the bearings [N/m], or factor of it")
            .axis("stiffnesses+")
            .within(valid::positive),
        rows(&C::branches, "map_branches").numbered("branch", "branch"),
        column("curve_speed", &C::curve_speeds, "rad/s", "rotor speed of the bearings' stiffness")
            .axis("curve_speeds+")
            .within(valid::positive)
            .maybe(),
        rows(&C::curves, "stiffness_curves").prefixed("curve_").maybe(),
        rows(&C::crossings, "map_crossings").prefixed("crossing_").maybe(),
        rows(&C::gaps, "map_gaps").prefixed("gap_").maybe()};
  }
};

/// The critical speed map of a structure.
///
/// With bearings that are alike, or that change with speed, x is a stiffness that all of them have
/// in all directions, and their own stiffness goes on top, so that critical speeds are where these
/// cross [API684]. With bearings that differ, x is a factor of all of them. Rigid bearings stay as
/// they are, and so do seals with their stiffness at rest, and springs without an end on the shaft,
/// as those between pedestals and the ground; damping is left out.
///
/// Linearized connections, as oil films, are bearings that change with speed.
///
/// Critical speeds are followed by their shapes. They rise with stiffness, no faster than its
/// square root, so that a branch leaves the map at its top only; where gyroscopics keep a mode from
/// being critical, it has no branch.
///
/// @return  no branches if no bearing has a stiffness
CriticalMap critical_map(const Structure& structure, const CriticalMapOptions& options);

/// The map of critical speeds that were found: up to as many of the stiffest bearings, and over the
/// stiffness that linearized connections have at them.
CriticalMap critical_map_of(const Structure& structure, const CriticalSpeeds& found);

}  // namespace whirl::inline fe
