#pragma once
/// Rules of the lateral analysis of compressors [API617]: what of unbalance, vibration, distance
/// and damping they ask for. Formulas only, in SI.

#include <array>

#include "libbase/structs/field.hpp"
#include "libfe/analyses/amplification.hpp"

namespace whirl::inline fe {

/// Speeds of a machine [rad/s].
struct OperatingRange {
  double minimum = 0.0, maximum = 0.0;  ///< that it runs at continuously, 0 < minimum <= maximum
  double trip = 0.0;                    ///< at which it is stopped, maximum or more
};

/// Unbalance of a plane, the allowed residual one twice.
///
///   U = 2 * 6350 W / N   [g.mm], W [kg], N [rpm]
///
/// @param mass     W: what the journals carry that belong to the plane [kg]
/// @param maximum  N: maximum continuous speed [rad/s]
/// @return         [kg.m]
/// @source [API617], residual unbalance; [API684]
double analysis_unbalance(double mass, double maximum);

/// Allowed vibration of the shaft at probes, peak to peak: the less of 25.4 um (1 mil) and
/// 25.4 sqrt(12 000 / N) um with N [rpm].
///
/// @param maximum  N: maximum continuous speed [rad/s]
/// @return         [m]
/// @source [API617]
double vibration_limit(double maximum);

/// How far a peak is from the speeds of a machine, and should be: from the minimum where it is
/// below them, from the maximum where it is above. Among them its distance is zero.
///
/// @source [API617], as separation_margin(peak, operating)
SeparationMargin separation_margin(const ResponsePeak& peak, const OperatingRange& range);

/// A running clearance may be taken up to this share.
inline constexpr double clearance_share = 0.75;
/// Responses are scaled up to the vibration limit, at most so many times, for clearances.
inline constexpr double most_scaling = 6.0;
/// Least logarithmic decrement with the anticipated cross-coupling, and least ratio of the
/// cross-coupling that the rotor bears to it, in an analysis of level I.
inline constexpr double least_log_decrement = 0.1;
inline constexpr double least_coupling_ratio = 2.0;
/// The same ratio where a compressor is in region B of the screening.
inline constexpr double least_coupling_ratio_in_region_b = 10.0;

/// The screening of a compressor: light gas and a stiff rotor, or dense gas or a flexible one.
enum class StabilityRegion { a, b };
constexpr auto choices(StabilityRegion) {
  using enum StabilityRegion;
  return std::array{Choice<StabilityRegion>{"A", a}, Choice<StabilityRegion>{"B", b}};
}

/// The largest critical speed ratio of region A at a density.
///
///   the less of 2.5 and 2.69 - 0.0115 rho,   rho <= 60 kg/m^3;   beyond, none: zero
///
/// The standard draws this line; the numbers are those that [Timbo2020] reads from it.
///
/// @param density  average of that of the gas where it enters and where it leaves [kg/m^3]
/// @source [API617], screening of level I; [Timbo2020], report after API 617
double largest_speed_ratio(double density);

/// @param speed_ratio  critical speed ratio: maximum continuous speed over the first critical speed
///                     on rigid supports
/// @source as largest_speed_ratio
StabilityRegion stability_region(double speed_ratio, double density);

/// Power of an impeller and the passage of its gas.
struct Stage {
  double power = 0.0;          ///< [W]
  double diameter = 0.0;       ///< of the impeller [m]
  double width = 0.0;          ///< least one of the diffuser and of the impeller's discharge [m]
  double density_ratio = 1.0;  ///< of the gas, discharge over suction
};

/// Cross-coupled stiffness that the gas of an impeller is expected to make.
///
///   q = 3 T / (D H) rho_d / rho_s,   T = power / speed
///
/// @param maximum  speed that the power is taken at [rad/s]
/// @return         [N/m]
/// @source [API617], stability analysis of level I; Wachel's formula of 1981 with density ratios
double anticipated_coupling(const Stage& stage, double maximum);

}  // namespace whirl::inline fe
