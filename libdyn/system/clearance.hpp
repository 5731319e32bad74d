#pragma once
/// How much of its clearances a rotor takes if it moves as if there were no contacts.

#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

struct Model;

/// A range of speeds [rad/s].
struct SpeedRange {
  double first = 0.0, last = 0.0;
};

/// What the steady response to unbalance takes of one clearance.
struct ClearanceUse {
  std::string name;                ///< "contact ring", "oil film left", "seal eye"
  double clearance = 0.0;          ///< [m]
  double largest = 0.0;            ///< distance from the middle of the clearance [m]
  double at = 0.0;                 ///< speed of the largest distance [rad/s]
  std::vector<SpeedRange> beyond;  ///< where the distance is more than the clearance

  static constexpr auto columns() {
    constexpr auto ranges = [](const ClearanceUse& use) {
      std::vector<std::vector<double>> all;
      for (const SpeedRange& r : use.beyond) all.push_back({r.first, r.last});
      return all;
    };
    return ColumnList{column("name", &ClearanceUse::name, "", "whose clearance it is"),
                      column("clearance", &ClearanceUse::clearance, "m", "clearance"),
                      column("largest", &ClearanceUse::largest, "m", "largest distance"),
                      column("largest_at", &ClearanceUse::at, "rad/s", "where it is that far"),
                      column("beyond", ranges, "rad/s", "where it is more than the clearance")};
  }
};

/// What is left of one clearance where the rotor rests, or in a motion.
struct RunningClearance {
  std::string name;        ///< "contact ring", "oil film left", "seal eye"
  double clearance = 0.0;  ///< [m]
  double distance = 0.0;   ///< from the middle of the clearance, with a stop towards the stop [m]

  double left() const { return clearance - distance; }

  static constexpr auto columns() {
    using R = RunningClearance;
    return ColumnList{column("name", &R::name, "", "whose clearance it is"),
                      column("clearance", &R::clearance, "m", "clearance"),
                      column("distance", &R::distance, "m", "of the rotor from its middle"),
                      column("left", &R::left, "m", "what is left of it")};
  }
};

/// Running clearances of a rotor at rest, the closest first: of contacts, of oil films, and of
/// those bearings and seals that tell a clearance.
/// @param displacement  full vector, see DofMap [m, rad]
std::vector<RunningClearance> running_clearances(const Model& model, const Assembler& assembler,
                                                 const Vec& displacement);

/// The same clearances where a motion takes most of each, in the order of the model.
/// @param basis, coordinates  displacements of all points (full vectors) are basis * coordinates,
///                            a column an instant
std::vector<RunningClearance> largest_distances(const Model& model, const Assembler& assembler,
                                                const Mat& basis, const Mat& coordinates);

/// The same clearances beside the linear response to unbalance.
///
/// The distance is the largest in a period: of the orbit from the middle of the clearance,
/// with a stop towards the stop, with a face that of its rim along the axis. Static sag is not part
/// of the response. An end of a range is the speed at which the distance is the clearance, to 1e-9
/// of the speed, or the first or last of the speeds.
///
/// @param speeds  ascending, near enough to each other [rad/s]: those of a ResponseCurve
/// @param load    of any frequency, in place of all that has the frequency of the speed; null:
/// these
std::vector<ClearanceUse> clearance_uses(const Model& model, const Assembler& assembler,
                                         const std::vector<double>& speeds,
                                         const Excitation* load = nullptr);

}  // namespace whirl::inline dyn
