#pragma once
/// Displacements that probes measured: channels of a record, by their gains.

#include <optional>
#include <string>
#include <vector>

#include "libdata/measured/key_phasor.hpp"
#include "libdata/measured/measured_record.hpp"
#include "libfe/parts/probe.hpp"

namespace whirl::inline data {

/// What a channel gives per displacement.
struct ProbeGain {
  enum class Of { length, voltage, number };
  Of of = Of::length;  ///< length: channels are lengths, the value gives scale and sign
  double value = 1.0;  ///< [1], [V/m], [1/m]; not zero
};

/// A probe with its channel.
struct MeasuredProbe {
  Probe probe;
  std::string channel;  ///< name or number
  ProbeGain gain{};
  double unit_length = 1e-6;   ///< unit of the probe, for channels without a unit [m]
  bool is_unit_given = false;  ///< whether somebody said that unit
  std::optional<FullScale> full_scale{};
};

/// How a record was measured.
struct MeasurementSetup {
  std::vector<MeasuredProbe> probes;
  std::optional<KeyPhasor> key_phasor{};
};

/// A record as displacements.
struct ProbeReadings {
  double rate = 0.0;   ///< [1/s]
  double start = 0.0;  ///< [s]
  std::vector<Probe> probes;
  Mat displacement;  ///< samples x probes [m]
  std::vector<std::vector<Eigen::Index>>
      missing{};  ///< per probe: samples that were missing, and that a straight line fills
  std::optional<TurnClock> clock{};
  std::vector<std::string> notes{};  ///< what is wrong with the record and could be helped

  double time(Eigen::Index sample) const { return start + static_cast<double>(sample) / rate; }
};

/// Reads the channels of probes, and the key-phasor if there is one: those of the record, or if it
/// has not all of these, of the one of its others that has.
///
/// Numbers of a channel without a unit are voltages if the gain is one of voltages, else lengths in
/// the unit of the probe, with a note. Shares of full scale need a full scale, unless the gain is
/// one of numbers. Gaps are filled, and clipped, constant and equal channels are noted.
///
/// @throws OptionError  for a channel that the record does not have or that is in no unit of its
///                      gain, for shares of a full scale that nobody says, and as without_gaps
///                      and TurnClock
ProbeReadings probe_readings(const MeasuredRecord& record, const MeasurementSetup& setup);

}  // namespace whirl::inline data
