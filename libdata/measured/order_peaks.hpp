#pragma once
/// Peaks of orders along a run-up: how high, how sharp.

#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libfe/analyses/amplification.hpp"

namespace whirl::inline data {

/// A peak of what a probe reads of an order; its row is the number of the curve, from 0.
struct OrderPeak : ResponsePeak {
  double phase = 0.0;  ///< there, ahead of the rotor's angle, -pi to pi [rad]

  double peak_to_peak() const { return 2.0 * amplitude; }
  double phase_deg() const { return phase / degree; }
  std::vector<double> half_power() const { return {below, above}; }

  static constexpr auto columns() {
    using enum Written;
    using P = OrderPeak;
    return ColumnList{
        column("speed", &P::speed, "rad/s", "speed of a peak").axis().within(valid::finite),
        column("curve", &P::row, "", "number of its curve, from 1")
            .within(valid::numbers_of("order_curves"))
            .from_one(),
        column("amplitude", &P::amplitude, "m", "half of its reading, peak to peak").only(in_file),
        column("below", &P::below, "rad/s", "0.707 of the peak, below it").only(in_file),
        column("above", &P::above, "rad/s", "0.707 of the peak, above it").only(in_file),
        column("phase", &P::phase, "rad", "phase there, ahead of the rotor's angle").only(in_file),
        column("peak_to_peak", &P::peak_to_peak, "m", "of the reading there").only(in_json),
        column("phase_deg", &P::phase_deg, "", "ahead of the rotor's angle").only(in_json),
        column("amplification", &P::amplification, "", "factor").only(in_json),
        column("half_power", &P::half_power, "rad/s", "0.707 of the peak").only(in_json)};
  }
};

/// Peaks of an order along speeds, as they were measured.
///
/// A peak is larger than all points between its half-power speeds, so that noise on its flanks is
/// none; one whose flanks do not fall to 0.707 on either side counts only if it is the largest of
/// the record. Its top is that of the parabola for 1 / amplitude^2 through all points above 0.95 of
/// it by least squares, which one lightly damped mode makes; its half-power speeds N1 and N2 lie
/// where the curve first falls below 0.707 of the top, between two points. Without five points
/// between these it counts only if it is the largest, and no amplification factor is told, nor is
/// one above 500, where the motion jumps. The drop from a peak to 0.707 of it is at least six
/// standard deviations of the noise.
///
///   AF = N_c / (N2 - N1)
///
/// @param speed     of the points, in any order [rad/s]
/// @param response  complex amplitude there [m]
/// @param curve     number of the curve, from 0
/// @param noise     standard deviation of either part of a point [m]; 0: not known
/// @return          ascending speeds, the eight highest; none where the speed changes by less than
///                  a tenth
/// @source [API617], [API684]: amplification factor from the half-power points
std::vector<OrderPeak> order_peaks(const Vec& speed, const CVec& response, Eigen::Index curve,
                                   double noise = 0.0);

}  // namespace whirl::inline data
