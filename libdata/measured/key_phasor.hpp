#pragma once
/// A key-phasor: pulses of a mark on the shaft, from which speed and phase follow.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libdata/measured/measured_record.hpp"

namespace whirl::inline data {

/// The edge of a pulse at which the mark is in front of the key-phasor.
enum class PulseEdge { rising, falling };
constexpr auto choices(PulseEdge) {
  return std::array{Choice<PulseEdge>{"rising", PulseEdge::rising},
                    Choice<PulseEdge>{"falling", PulseEdge::falling}};
}

struct KeyPhasor {
  std::string channel;              ///< name or number
  std::optional<double> threshold;  ///< [V, m, or as the channel]; nothing: halfway of its range
  PulseEdge slope = PulseEdge::rising;
  int pulses = 1;                         ///< per revolution
  double angle = 0.0;                     ///< of the rotor at a pulse, from +x towards +y [rad]
  std::string threshold_unit{};           ///< "V" or "m"; "": that of the channel
  std::optional<FullScale> full_scale{};  ///< of a channel of shares

  static constexpr auto fields() {
    using enum Range;
    using K = KeyPhasor;
    return std::tuple{
        optional("slope", &K::slope, "", any, "edge of the pulses that counts: rising or falling"),
        optional("pulses", &K::pulses, "", positive, "pulses per revolution"),
        optional("angle", &K::angle, "rad", any, "of the rotor at a pulse, from +x towards +y")};
  }
};

/// Times at which a signal crosses the threshold, located between samples by a straight line [s].
///
/// Another pulse counts only after the signal has gone back from the threshold by a fifth of its
/// range, or by half the way to the end of its range if that is less, so that noise at the
/// threshold makes no pulses.
std::vector<double> pulse_times(const Vec& samples, const MeasuredRecord& record,
                                const KeyPhasor& key);

/// The angle that a rotor has turned by, from times of pulses.
///
/// Between pulses the angle is the cubic whose slopes at pulses are those of parabolas through
/// three pulses: exact where the speed changes evenly.
class TurnClock {
 public:
  /// Up to three pulses that are missing one after the other are put between their neighbors, and a
  /// pulse that cuts an interval in two is left out; an interval is compared with the median of
  /// those about it.
  ///
  /// @param notes  receives where pulses are missing or too many
  /// @throws OptionError  for fewer than three pulses
  TurnClock(std::vector<double> pulses, const KeyPhasor& key, std::vector<std::string>& notes);

  /// Times of every revolution's first pulse [s].
  std::vector<double> turns() const;
  double first() const { return pulses_.front(); }  ///< [s]
  double last() const { return pulses_.back(); }    ///< [s]
  /// Angle of the rotor from +x towards +y, which goes on growing [rad]; first() <= t <= last().
  double angle(double t) const;
  /// Rate of the angle [rad/s].
  double speed(double t) const;
  double mean_speed() const;  ///< [rad/s]
  /// Largest less smallest speed of a revolution, over the mean.
  double variation() const;

 private:
  struct Piece {
    double h = 0.0, s = 0.0, slope_0 = 0.0, slope_1 = 0.0;
    std::size_t number = 0;
  };
  Piece piece_at(double t) const;
  void note_jump(const KeyPhasor& key, std::vector<std::string>& notes) const;
  void set_slopes();

  std::vector<double> pulses_, slopes_;  ///< [s], [pulses/s]
  int per_turn_ = 1;
  double angle_ = 0.0;
};

}  // namespace whirl::inline data
