#pragma once
/// A rolling bearing at rest under its load, as a result.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/system/contact_system.hpp"
#include "libdyn/system/running_film.hpp"

namespace whirl::inline dyn {

/// A rolling bearing in static equilibrium, its cage where it is at time 0.
struct RunningBearing {
  std::string name;
  Vec2 place = Vec2::Zero();      ///< displacement of the inner ring from the middle [m]
  Vec2 load = Vec2::Zero();       ///< of the inner ring on the bearing [N]
  int loaded = 0;                 ///< elements that are pressed
  double largest = 0.0;           ///< radial load of the element that is pressed most [N]
  Mat2 stiffness = Mat2::Zero();  ///< force = -K u about the place [N/m]
  std::vector<double> elements;   ///< radial load of each [N]

  double fx() const { return load(0); }
  double fy() const { return load(1); }
  PlaneCoefficients stiffness_parts() const { return PlaneCoefficients(stiffness); }

  static constexpr auto columns() {
    using enum Written;
    using R = RunningBearing;
    return ColumnList{
        column("name", &R::name, "", "rolling bearing").axis(),
        column("loaded", &R::loaded, "", "balls or rollers that are pressed"),
        column("largest", &R::largest, "N", "radial load of the one that is pressed most"),
        column("place", &R::place, "m", "displacement of the inner ring (x, y)")
            .along("2")
            .only(in_file),
        column("load", &R::load, "N", "force of the inner ring on the bearing (x, y)")
            .along("2")
            .only(in_file),
        column("fx", &R::fx, "N", "force of the inner ring on the bearing").only(in_json),
        column("fy", &R::fy, "N", "force of the inner ring on the bearing").only(in_json),
        column("elements", &R::elements, "N", "radial load of each, the one at cage_angle first")
            .only(in_json),
        column("stiffness", &R::stiffness, "N/m", "stiffness about the place")
            .along("2 2")
            .only(in_file),
        column("stiffness", &R::stiffness_parts, "", "stiffness about the place").only(in_json)};
  }
};

/// All rolling bearings of a rotor, as a group of a result file.
struct RunningBearings {
  std::vector<RunningBearing> bearings;

  static constexpr std::string_view group = "/rolling_bearings";
  static constexpr auto columns() {
    return ColumnList{rows(&RunningBearings::bearings, "rolling_bearings")};
  }
};

/// The elements of a rolling bearing of a model, each as a contact without the rotor's rows.
std::vector<ReducedContact> elements_of(const Contact& bearing, const PartSpeeds& speeds);

/// A rolling bearing at a displacement of its inner ring from the middle [m].
RunningBearing running_bearing(const Contact& bearing, const Vec2& place, const PartSpeeds& speeds);

/// The normal force of a contact at rest at time 0, with its slopes.
struct RestingPush {
  Vec2 force;  ///< on the rotor [N]
  Mat2 by_u;   ///< [N/m]
};
/// @param d  from the middle of its clearance
RestingPush resting_push(const ReducedContact& contact, const Vec2& d);

}  // namespace whirl::inline dyn
