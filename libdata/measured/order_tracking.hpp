#pragma once
/// Order tracking: amplitude and phase of multiples of the speed while the speed changes.

#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

constexpr double fewest_order_revolutions = 2.0;  ///< that a point can be made of

struct OrderOptions {
  std::vector<double> orders{1.0, 2.0};  ///< frequencies over speed, each above zero
  double revolutions = 8.0;              ///< that a point is made of
  /// Speed of the slow roll: the readings at the point nearest to it are taken off all points of a
  /// run-up, as runout does not change with speed [rad/s].
  std::optional<double> slow_roll{};
};

/// What a probe reads of an order along a run-up.
struct OrderCurve : ProbeLabel {
  double order = 0.0;
  CVec response;  ///< per point, reading = Re(response e^(i order angle)) [m]

  /// Peak to peak, as probes of machines tell it [m].
  Vec peak_to_peak() const { return 2.0 * response.cwiseAbs(); }

  static constexpr auto columns() {
    using enum Written;
    using C = OrderCurve;
    return joined(ProbeLabel::columns(),
                  ColumnList{column("order", &C::order, "", "frequency over speed"),
                             column("response", &C::response, "m",
                                    "complex reading of a probe, reading = Re(response e^(i order "
                                    "angle)), angle that of the rotor")
                                 .along("tracked"),
                             column("peak_to_peak", &C::peak_to_peak, "m", "of the order")
                                 .along("tracked")
                                 .only(in_json)});
  }
};

/// Orders of all probes along a record; group /orders.
struct OrderTracking {
  Vec time;   ///< of the middles of the points [s]
  Vec speed;  ///< there [rad/s]
  std::vector<OrderCurve> curves;
  std::optional<double> slow_roll{};  ///< speed of the point that was taken off [rad/s]

  static constexpr std::string_view group = "/orders";
  static constexpr auto columns() {
    using O = OrderTracking;
    return ColumnList{
        column("time", &O::time, "s", "time of a point").axis("tracked+").within(valid::finite),
        column("speed", &O::speed, "rad/s", "speed of the rotor")
            .along("tracked")
            .within(valid::finite),
        rows(&O::curves, "order_curves+").prefixed("probe_"),
        column("slow_roll", &O::slow_roll, "rad/s", "speed of the point that was taken off all")
            .maybe()};
  }
};

/// Tracks orders along a record with a key-phasor.
///
/// A point is made of some revolutions; the next point begins half as many revolutions later. In
/// these revolutions the readings are taken as a constant and all orders, by least squares weighted
/// by a Hann window over the angle of the rotor:
///
///   p_j = c + sum_q Re(C_q e^(i q angle_j))
///
/// so that samples need not go evenly into revolutions, and orders do not leak into one another.
///
/// @pre    readings.clock
/// @throws OptionError  for a record of fewer revolutions than a point has, and for samples too few
///                      to show the orders
OrderTracking track_orders(const ProbeReadings& readings, const OrderOptions& options);

}  // namespace whirl::inline data
