#pragma once
/// Forces on bearings, seals, links and oil films under the steady response, as rows of results.

#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

/// The force of the rotor on one of these parts: F(t) = Re(value e^(i w t)). Forces that last, as
/// the weight, are not in it.
struct BearingResponse {
  std::string kind;  ///< "bearing", "seal", "link", "oil film"
  std::string name;
  CVec x, y;                  ///< complex amplitudes, per speed [N]
  CVec curve_x{}, curve_y{};  ///< over the curve's speeds; empty if the speeds are those
  double largest = 0.0, largest_at = 0.0;  ///< largest force of all speeds, its speed [N], [rad/s]

  /// Largest force in a period, per speed [N].
  Vec force() const;
  /// Phases ahead of the angle of the load, -180 to 180 [deg].
  Vec x_phase() const;
  Vec y_phase() const;

  /// Columns of forces at the speeds asked for.
  static constexpr auto speed_columns() {
    using enum Written;
    using B = BearingResponse;
    return ColumnList{
        column("kind", &B::kind, "", "bearing, seal, link, oil film or rolling bearing"),
        column("name", &B::name, "", "its name").axis(),
        column("force", &B::force, "N", "largest force in a period").only(in_json),
        column("x_phase_deg", &B::x_phase, "", "of the force along x").only(in_json),
        column("y_phase_deg", &B::y_phase, "", "of the force along y").only(in_json),
        column("force_x", &B::x, "N", "complex amplitude of the force along x").along("speeds"),
        column("force_y", &B::y, "N", "complex amplitude of the force along y").along("speeds"),
        column("largest", &B::largest, "N", "largest force of all speeds"),
        column("largest_at", &B::largest_at, "rad/s", "speed of the largest force")};
  }
  static constexpr auto columns() {
    using enum Written;
    using B = BearingResponse;
    return joined(
        speed_columns(),
        ColumnList{
            column("curve_force_x", &B::curve_x, "N", "complex amplitude of the force along x")
                .along("curve")
                .only(in_file)
                .maybe(),
            column("curve_force_y", &B::curve_y, "N", "complex amplitude of the force along y")
                .along("curve")
                .only(in_file)
                .maybe()});
  }
};

/// Forces under loads of the frequency of the speed, on all carrying_parts.
/// @param known  the response at some points; what it lacks is solved for
std::vector<BearingResponse> bearing_responses(const Assembler& assembler,
                                               const UnbalanceResponse& known);

/// Forces under a load of another frequency.
/// @return  x, y: NaN at speeds where the dynamic stiffness is singular
std::vector<BearingResponse> bearing_responses(const Assembler& assembler, const Excitation& load,
                                               const std::vector<double>& speeds);

}  // namespace whirl::inline dyn
