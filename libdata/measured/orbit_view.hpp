#pragma once
/// Orbits of a station at a moment: as they are, of one order, of a band of frequencies, averaged
/// over revolutions, without slow roll.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libdata/measured/key_phasor.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline data {

/// Fewest revolutions that an order or an average can be made of.
constexpr double fewest_orbit_revolutions = 3.0;

/// What of a motion is looked at. An order, a band and an average exclude one another.
struct OrbitFilter {
  std::optional<double> order{};                    ///< this multiple of the speed alone, > 0
  std::optional<std::pair<double, double>> band{};  ///< these frequencies alone [rad/s]
  bool is_averaged = false;                         ///< averaged to one revolution
  double revolutions = 8.0;                         ///< about the moment, that are looked at
  /// Speed whose motion is taken off, as runout does not change with speed: of an order its vector,
  /// else the waveform of one revolution [rad/s].
  std::optional<double> slow_roll{};

  /// "raw", "1X", "10 to 200 Hz", "average of 8 revolutions"
  std::string text() const;
};

/// The path of a station about a moment. Its mean position, the gap, is left out.
struct StationOrbit {
  double time = 0.0;           ///< of the moment [s]
  double speed = 0.0;          ///< there [rad/s]
  double revolutions = 0.0;    ///< that were looked at
  Vec t;                       ///< of the points; of orders and averages since a pulse [s]
  Vec x, y;                    ///< of the points [m]
  std::vector<Complex> marks;  ///< x + i y at pulses of the key-phasor [m]
  Complex gap;                 ///< mean position [m]
  /// Complex amplitudes of an order: x = Re(a_x e^(i order angle)), and y likewise [m].
  Complex a_x, a_y;
  std::optional<double> slow_roll{};  ///< speed at which was measured what is taken off [rad/s]

  /// Radii of the circles that make up the ellipse of an order [m].
  double forward() const { return 0.5 * std::abs(a_x + Complex(0.0, 1.0) * a_y); }
  double backward() const { return 0.5 * std::abs(a_x - Complex(0.0, 1.0) * a_y); }
};

/// A motion of stations with the revolutions of the rotor, of a record or of a simulation.
struct TurnedMotion {
  Vec time;                                    ///< of the samples, at equal steps [s]
  std::vector<const StationMotion*> stations;  ///< of as many samples; never null
  TurnClock clock;                             ///< pulses of once a revolution
  bool has_marks = true;                       ///< whether these are those of a key-phasor

  double spacing() const {
    return (time(time.size() - 1) - time(0)) / static_cast<double>(time.size() - 1);
  }
};

/// The first moment at which the rotor has a speed [s].
/// @throws OptionError  if it never has; says between which speeds it turns
double moment_of_speed(const TurnClock& clock, double speed);

/// The orbit of a station about a moment.
///
/// A raw orbit is made of the samples of whole revolutions, without their mean. An order is fitted
/// to them by least squares (OrderFit); an average is made of the orders 1, 2, ... up to 32 or what
/// the samples of a revolution show, which is the average over the angle of the rotor without a
/// grid. A band is that of the whole motion (band_passed).
///
/// @param station  number, from 0
/// @param at       the moment; the revolutions begin half as many before it, as far as there are
/// [s]
/// @throws OptionError  for a moment outside of the motion, and for fewer revolutions than
///                      fewest_orbit_revolutions or samples where orders or averages are asked for
StationOrbit orbit_at(const TurnedMotion& motion, std::size_t station, double at,
                      const OrbitFilter& filter);

}  // namespace whirl::inline data
