#pragma once
/// Bending of the shaft under its static loads: deflection, moment and shear force along it.

#include "libbase/structs/column.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

/// What a cut through the shaft shows, position by position.
///
///   moment = E I (x'', y''),   shear = kappa G A (x' - theta_y, y' + theta_x) = -moment'
///
/// Under gravity a shaft between two bearings sags (y < 0) with a moment of the y-z plane above
/// zero. The shear force is that of the right part on the left one. Both ends of every beam are
/// listed, so that inner nodes stand there twice: a bearing or a disk makes the shear force jump.
struct BendingLine {
  Vec z;           ///< positions, shaft by shaft, ascending along each [m]
  Mat deflection;  ///< positions x 2: x, y [m]
  Mat moment;      ///< positions x 2: of the planes x-z, y-z [N.m]
  Mat shear;       ///< positions x 2: along x, y [N]
  /// Nominal ones of the shaft, largest in the section: no steps, fillets, keyways. Layers carry
  /// their shares of moment and shear force.
  Vec bending_stress{}, shear_stress{};  ///< per position [Pa]

  static constexpr std::string_view group = "/static";
  static constexpr auto columns() {
    using enum Written;
    constexpr auto in_plane = [](auto member, int plane) {
      return [member, plane](const BendingLine& line) { return Vec((line.*member).col(plane)); };
    };
    constexpr auto deflection = &BendingLine::deflection, moment = &BendingLine::moment,
                   shear = &BendingLine::shear;
    return ColumnList{
        column("z", &BendingLine::z, "m", "position along the shaft, both ends of every beam")
            .axis("along+")
            .within(valid::finite),
        column("deflection", deflection, "m", "static deflection (x, y)")
            .along("along 2")
            .within(valid::finite)
            .only(in_file),
        column("moment", moment, "N.m", "bending moment (of the planes x-z, y-z)")
            .along("along 2")
            .within(valid::finite)
            .only(in_file),
        column("shear", shear, "N", "shear force of the right part on the left one (x, y)")
            .along("along 2")
            .within(valid::finite)
            .only(in_file),
        column("bending_stress", &BendingLine::bending_stress, "Pa",
               "largest bending stress of the section, nominal")
            .along("along")
            .within(valid::finite)
            .maybe(),
        column("shear_stress", &BendingLine::shear_stress, "Pa",
               "largest shear stress of the section, nominal")
            .along("along")
            .within(valid::finite)
            .maybe(),
        column("x", in_plane(deflection, 0), "m", "deflection").only(in_json),
        column("y", in_plane(deflection, 1), "m", "deflection").only(in_json),
        column("moment_x", in_plane(moment, 0), "N.m", "of the plane x-z").only(in_json),
        column("moment_y", in_plane(moment, 1), "N.m", "of the plane y-z").only(in_json),
        column("shear_x", in_plane(shear, 0), "N", "along x").only(in_json),
        column("shear_y", in_plane(shear, 1), "N", "along y").only(in_json)};
  }
};

/// The bending line of a static equilibrium.
///
/// Moments and shear forces follow from the forces at the ends of each beam and its own weight, so
/// that they are in equilibrium with loads and bearings. Deflections between the nodes are those of
/// the beam under its weight with the displacements of its ends. Both are exact without axial
/// forces; with them the share of N in the moment takes a cubic deflection within a beam. Damping
/// inside the shaft carries its part of the moment while the shaft spins. Stresses are those of a
/// cylinder of the outer and inner radius r, q at the position:
///
///   sigma = M r / I,   tau = 4 V / (3 A) (r^2 + r q + q^2) / (r^2 + q^2)
///
/// @param Omega         speed of the equilibrium [rad/s]
/// @param displacement  full vector, see DofMap [m, rad]
/// @return  no positions if there is no shaft
BendingLine bending_line(const Assembler& assembler, double Omega, const Vec& displacement);

}  // namespace whirl::inline fe
