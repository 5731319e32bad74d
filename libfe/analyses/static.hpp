#pragma once
/// Static equilibrium: sag under gravity and what the bearings carry.

#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

struct BearingLoad {
  std::string name;
  Vec2 force = Vec2::Zero();  ///< of the rotor on the bearing, (x, y) [N]

  double fx() const { return force(0); }
  double fy() const { return force(1); }

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("bearing", &BearingLoad::name, "", "bearing").axis().as("name"),
        column("bearing_load", &BearingLoad::force, "N", "force of the rotor on the bearing (x, y)")
            .along("2")
            .only(in_file),
        column("fx", &BearingLoad::fx, "N", "force of the rotor on the bearing").only(in_json),
        column("fy", &BearingLoad::fy, "N", "force of the rotor on the bearing").only(in_json)};
  }
};

/// The same of a link, such as one between a pedestal and its foundation.
struct LinkLoad : BearingLoad {
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("link", &LinkLoad::name, "", "link").axis().as("name"),
        column("link_load", &LinkLoad::force, "N",
               "force of the first station of the link on the second (x, y)")
            .along("2")
            .only(in_file),
        column("fx", &LinkLoad::fx, "N", "force of the first station on the second").only(in_json),
        column("fy", &LinkLoad::fy, "N", "force of the first station on the second").only(in_json)};
  }
};

struct StaticEquilibrium {
  Vec displacement;                   ///< full vector, see DofMap [m, rad]
  std::vector<BearingLoad> bearings;  ///< of bearings, then of seals
  std::vector<LinkLoad> links;

  static constexpr std::string_view group = "/static";
  static constexpr auto columns() {
    return ColumnList{
        column("displacement", &StaticEquilibrium::displacement, "m, rad",
               "static displacement: x, y, theta_x, theta_y of every node, then of every body")
            .along("full")
            .only(Written::in_file),
        rows(&StaticEquilibrium::bearings, "bearings").maybe(),
        rows(&StaticEquilibrium::links, "links").maybe()};
  }
};

/// Equilibrium under gravity and constant forces f at a speed [rad/s]:
/// (K + Omega H) q = -g M e_y + f.
/// @throws ModelError  if the rotor is free
StaticEquilibrium static_equilibrium(const Assembler& assembler, double Omega);

/// What the bearings carry where the rotor rests at q under a full load [N, N.m].
/// @param system  of the assembler, nothing condensed
StaticEquilibrium with_bearing_loads(const Assembler& assembler, const System& system, const Vec& q,
                                     const Vec& load);

/// Checks that no rigid-body motion is free at a speed.
/// @param what  begins the message, "the static sag needs"
/// @throws ModelError  if one is
void require_supports(const Assembler& assembler, double Omega, std::string_view what);

}  // namespace whirl::inline fe
