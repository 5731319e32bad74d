#pragma once
/// Order tracking: amplitude and phase of multiples of the speed while the speed changes.

#include <vector>

#include "libdata/measured/order_peaks.hpp"
#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

constexpr double fewest_order_revolutions = 2.0;  ///< that a point can be made of
constexpr double least_order_step = 0.1;          ///< revolutions from a point to the next

struct OrderOptions {
  std::vector<double> orders{1.0, 2.0};  ///< frequencies over speed, each above zero
  double revolutions = 8.0;              ///< that a point is made of
  /// Revolutions from a point to the next; nothing: half of a point's where the speed is steady,
  /// one along a run-up, so that a resonance has points enough, but not more than 4000 points.
  std::optional<double> step{};
  /// Speed of the slow roll: the readings at the point nearest to it are taken off all points of a
  /// run-up, as runout does not change with speed [rad/s].
  std::optional<double> slow_roll{};
};

/// What a probe reads of an order along a run-up.
struct OrderCurve : ProbeLabel {
  double order = 0.0;
  CVec response;  ///< per point, reading = Re(response e^(i order angle)) [m]

  CVec model{};  ///< what it would read of the model; empty: nobody asked [m]

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
                                 .only(in_json),
                             column("model", &C::model, "m",
                                    "complex reading of a probe in the model's response to its "
                                    "unbalances, scaled")
                                 .along("tracked")
                                 .maybe()});
  }
};

/// The 1X shape of a record at a peak, beside the mode that is most like it.
struct OrderShape {
  double speed = 0.0;      ///< of the rotor at the peak [rad/s]
  int mode = 0;            ///< number among the modes of the model at that speed, from 1; 0: none
  double frequency = 0.0;  ///< of that mode [rad/s]
  double mac = 0.0;        ///< of the readings of both
  std::string whirl;       ///< of that mode
  double second = 0.0;     ///< MAC of the next one

  static constexpr auto columns() {
    using S = OrderShape;
    return ColumnList{
        column("speed", &S::speed, "rad/s", "speed of a peak of 1X at all probes together")
            .axis()
            .within(valid::finite),
        column("mode", &S::mode, "", "number of the mode most like the shape there; 0: none"),
        column("frequency", &S::frequency, "rad/s", "of that mode, at that speed"),
        column("mac", &S::mac, "", "of the readings of the shape and that mode"),
        column("whirl", &S::whirl, "", "of that mode"),
        column("second_mac", &S::second, "", "of the next mode")};
  }
};

/// Orders of all probes along a record; group /orders.
struct OrderTracking {
  Vec time;   ///< of the middles of the points [s]
  Vec speed;  ///< there [rad/s]
  std::vector<OrderCurve> curves;
  std::optional<double> slow_roll{};  ///< speed of the point that was taken off [rad/s]
  std::vector<OrderPeak> peaks{};     ///< of all curves, curve by curve
  std::vector<OrderShape> shapes{};   ///< of 1X
  /// What the model's response is times, as a factor and an angle [rad]; nothing: nobody asked.
  std::optional<double> model_factor{}, model_turn{};

  static constexpr std::string_view group = "/orders";
  static constexpr auto columns() {
    using O = OrderTracking;
    return ColumnList{
        column("time", &O::time, "s", "time of a point").axis("tracked+").within(valid::finite),
        column("speed", &O::speed, "rad/s", "speed of the rotor")
            .along("tracked")
            .within(valid::finite),
        rows(&O::curves, "order_curves+").prefixed("probe_"),
        rows(&O::peaks, "order_peaks").prefixed("peak_").maybe(),
        rows(&O::shapes, "order_shapes").prefixed("shape_").maybe(),
        column("slow_roll", &O::slow_roll, "rad/s", "speed of the point that was taken off all")
            .maybe(),
        column("model_factor", &O::model_factor, "",
               "that the unbalances of the model are times in its curve")
            .maybe(),
        column("model_turn", &O::model_turn, "rad", "that they are turned by").maybe()};
  }
};

/// Tracks orders along a record with a key-phasor.
///
/// A point is made of some revolutions; the next point begins a step later. In these revolutions
/// the readings are taken as a constant and all orders, by least squares weighted by a Hann window
/// over the angle of the rotor:
///
///   p_j = c + sum_q Re(C_q e^(i q angle_j))
///
/// so that samples need not go evenly into revolutions, and orders do not leak into one another.
/// Speed and time of a point are those of the parabola of the angle over 32 revolutions. Peaks are
/// those of what is left when slow roll is taken off (order_peaks), above the noise of the curve.
///
/// @pre    readings.clock
/// @throws OptionError  for a record of fewer revolutions than a point has, and for samples too few
///                      to show the orders
OrderTracking track_orders(const ProbeReadings& readings, const OrderOptions& options);

}  // namespace whirl::inline data
