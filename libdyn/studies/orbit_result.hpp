#pragma once
/// Periodic orbits as results (libbase/structs/column.hpp); group /orbit.

#include "libbase/structs/column.hpp"
#include "libdyn/studies/found_orbit.hpp"

namespace whirl::inline dyn {

/// An orbit's stability, and the motion of all points along it.
struct OrbitResult {
  CVec multipliers, exponents;  ///< [-], [1/s]
  Mat displacement, velocity;  ///< full vectors x revolutions [m, rad], [m/s, rad/s]; empty: of the
                               ///< rotating frame
  double period = 0.0;         ///< [revolutions]
  double residual = 0.0;       ///< [length scales]
  int is_stable = 0;

  static constexpr std::string_view group = "/orbit";
  static constexpr auto columns() {
    return ColumnList{
        column("multiplier", &OrbitResult::multipliers, "",
               "Floquet multipliers of the period, the largest first")
            .axis("multipliers"),
        column("exponent", &OrbitResult::exponents, "1/s",
               "Floquet exponents, log(multiplier) / period")
            .along("multipliers")
            .maybe(),
        column("displacement", &OrbitResult::displacement, "m, rad",
               "displacement of all points at the starts of revolutions")
            .along("full starts")
            .maybe(),
        column("velocity", &OrbitResult::velocity, "m/s, rad/s",
               "velocity of all points at the starts of revolutions")
            .along("full starts")
            .maybe(),
        column("period_revolutions", &OrbitResult::period, "", "revolutions of the period").maybe(),
        column("residual", &OrbitResult::residual, "", "in length scales").maybe(),
        column("stable", &OrbitResult::is_stable, "", "1 stable, 0 unstable").maybe()};
  }
};
OrbitResult orbit_result(const Scene& scene, const FoundOrbit& orbit);
/// The result of an orbit that repeats as seen from the rotor.
OrbitResult orbit_result(const Scene& scene, const AutonomousOrbit& cycle);

}  // namespace whirl::inline dyn
