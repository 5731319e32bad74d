#pragma once
/// Controllers of magnetic bearings, from their parts.

#include <tuple>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libfe/parts/transfer_function.hpp"

namespace whirl::inline fe {

/// Proportional, integral and derivative action on a displacement:
///
///   i / u = P + I / s + D s / (1 + s / w_D)
struct PidController {
  double proportional = 0.0;          ///< P [A/m]
  double integral = 0.0;              ///< I [A/(m.s)]
  double derivative = 0.0;            ///< D [A.s/m]
  double derivative_bandwidth = 0.0;  ///< w_D [rad/s]; 0: without end

  static constexpr auto fields() {
    using enum Range;
    using P = PidController;
    return std::tuple{
        optional("proportional", &P::proportional, "A/m", any, "current per displacement"),
        optional("integral", &P::integral, "A/m/s", any, "current per displacement and time"),
        optional("derivative", &P::derivative, "A.s/m", any, "current per velocity"),
        alternative("derivative_bandwidth", &P::derivative_bandwidth, "rad/s", positive,
                    "up to which the derivative acts; left out: without end")};
  }
};
TransferFunction transfer_function(const PidController& pid);

/// What stands between the sensor and the force beside the controller.
struct LoopDynamics {
  double sensor_bandwidth = 0.0;     ///< of first order [rad/s]; 0: without end
  double amplifier_bandwidth = 0.0;  ///< likewise
  double delay = 0.0;                ///< of the whole loop [s]
  int pade_order = 4;                ///< of the delay

  static constexpr auto fields() {
    using enum Range;
    using L = LoopDynamics;
    return std::tuple{alternative("sensor_bandwidth", &L::sensor_bandwidth, "rad/s", positive,
                                  "of the sensors, first order; left out: without end"),
                      alternative("amplifier_bandwidth", &L::amplifier_bandwidth, "rad/s", positive,
                                  "of the amplifiers, first order; left out: without end"),
                      optional("delay", &L::delay, "s", nonnegative, "of the whole loop"),
                      optional("pade_order", &L::pade_order, "", positive,
                               "poles of the Pade approximation of the delay")};
  }
};

/// What an amplifier cannot exceed.
///
/// A current that is limited is that which the controller asks for. A voltage drives the coil
/// L i' + R i = v; with the bandwidth w of the current loop, v = L w (y - i) + R i where the
/// controller asks for y. Under both, the current is limited in the force that it makes, as by the
/// bias: the current loop goes on.
struct AmplifierLimits {
  double current_limit = 0.0;  ///< [A]; 0: none
  double voltage_limit = 0.0;  ///< [V]; 0: none
  double inductance = 0.0;     ///< L [H]
  double resistance = 0.0;     ///< R [ohm]

  bool any() const { return current_limit > 0.0 || voltage_limit > 0.0; }

  static constexpr auto fields() {
    using enum Range;
    using A = AmplifierLimits;
    return std::tuple{alternative("current_limit", &A::current_limit, "A", positive,
                                  "largest control current, of an axis; left out: none"),
                      alternative("voltage_limit", &A::voltage_limit, "V", positive,
                                  "largest voltage of an amplifier; left out: none"),
                      alternative("inductance", &A::inductance, "H", positive,
                                  "of the coil of an axis, under voltage_limit"),
                      optional("resistance", &A::resistance, "ohm", nonnegative,
                               "of the coil of an axis, under voltage_limit")};
  }
};

enum class FilterKind { low_pass, notch };
constexpr auto choices(FilterKind) {
  return std::array{Choice<FilterKind>{"low-pass", FilterKind::low_pass},
                    Choice<FilterKind>{"notch", FilterKind::notch}};
}

/// A filter of second order, 1 at rest: with w its frequency
///
///   low-pass  w^2 / (s^2 + 2 zeta w s + w^2)
///   notch     (s^2 + 2 depth zeta w s + w^2) / (s^2 + 2 zeta w s + w^2)
struct ControlFilter {
  FilterKind kind = FilterKind::low_pass;
  double frequency = 0.0;      ///< w [rad/s]
  double damping_ratio = 0.7;  ///< zeta
  double depth = 0.1;          ///< of a notch: what it lets through at its frequency

  static constexpr auto fields() {
    using enum Range;
    using F = ControlFilter;
    return std::tuple{optional("kind", &F::kind, "", any, "what it lets through"),
                      required("frequency", &F::frequency, "rad/s", positive, "of the filter"),
                      optional("damping_ratio", &F::damping_ratio, "", positive, "of its poles"),
                      optional("depth", &F::depth, "", nonnegative,
                               "of a notch: what it lets through at its frequency")};
  }
};
TransferFunction transfer_function(const ControlFilter& filter);

/// e^(-s T) by as many poles as zeros: the diagonal Pade approximation.
/// @source [GolubVanLoan2013], sec. 9.3
TransferFunction pade(double delay, int order);

/// The functions of sensor, amplifier and delay that are there.
std::vector<TransferFunction> transfer_functions(const LoopDynamics& loop);

/// The second law behind the first one: what the first gives is what the second takes. Only the
/// first one may give rates (D_rate), where the second passes nothing on at once (D is zero), or
/// has no states.
/// @throws NumericalError  where rates would be needed that are not there
StateSpace in_series(const StateSpace& first, const StateSpace& second);

/// Currents of axes, and which signals saturate on the way.
struct LimitedCurrents {
  StateSpace law;  ///< from displacements to currents [A/m]
  std::vector<SignalLimit> limits;
};

/// The currents i of amplifiers of first order, i' = w (y - i), that a controller asks for y; with
/// limits. Forces of what is beyond a limit are told in amperes.
/// @param bandwidth  w [rad/s]; 0: i = y
/// @throws NumericalError  where an amplifier would need a rate of the displacement, or a limit of
///     voltage has no inductance or no bandwidth
LimitedCurrents limited_currents(const StateSpace& control, double bandwidth,
                                 const AmplifierLimits& limits);

/// A law of one displacement and what stands behind it, one after the other. Factors that grow with
/// the frequency are taken together with others until none is left that does.
/// @throws NumericalError  where all of them together grow with the square of the frequency
StateSpace chain(const std::vector<TransferFunction>& functions);

}  // namespace whirl::inline fe
