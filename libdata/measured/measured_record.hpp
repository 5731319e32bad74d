#pragma once
/// A record of a measurement: samples of channels at equal steps of time, and what is wrong with
/// them.

#include <optional>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// The unit of samples that are shares of full scale, as sound files have them: what full scale is
/// only the recorder knows.
inline const std::string share_of_full_scale = "FS";

struct MeasuredChannel {
  std::string name;
  /// Of its samples: "m", "V", share_of_full_scale or any other; "": the file does not say it.
  std::string unit{};
};

/// What was measured.
struct MeasuredRecord {
  double rate = 0.0;   ///< samples per second [1/s]
  double start = 0.0;  ///< time of the first one [s]
  std::vector<MeasuredChannel> channels;
  Mat samples;  ///< samples x channels; lengths in m, voltages in V; NaN: missing
  std::vector<std::string> notes{};  ///< what its reader took for granted, in words

  double duration() const { return static_cast<double>(samples.rows()) / rate; }
  double time(Eigen::Index sample) const { return start + static_cast<double>(sample) / rate; }
  /// Names of the channels, for messages: "x [m], y [m]".
  std::string channel_list() const;
  /// The channel of a name, or of a number from 1 where none has it as its name.
  std::optional<Eigen::Index> channel(const std::string& name) const;
};

/// Share of the samples of a channel that may be missing.
constexpr double most_missing = 0.05;

/// Samples that are missing, and the channels that miss just these.
struct Gaps {
  std::vector<std::string> channels;
  std::vector<Eigen::Index> missing;  ///< one or more
  Eigen::Index samples = 0;           ///< of a channel

  /// How many, and when first.
  std::string text(const MeasuredRecord& record) const;
};

/// Samples with straight lines where there is no number; at the ends with the next number.
Vec filled(const Vec& samples);

/// Fills missing samples of a channel by straight lines between their neighbors.
///
/// @param name  of the channel
/// @param gaps  of the channels before; receives its own
/// @throws OptionError  if more than a twentieth is missing
Vec without_gaps(const Vec& samples, const MeasuredRecord& record, const std::string& name,
                 std::vector<Gaps>& gaps);

/// Whether a signal was cut off: at its largest or smallest value it rests for three samples or
/// more, and comes there by steps of more than two of the smallest that it makes. What was
/// digitized coarsely rests at its crests, too, but comes there by the smallest steps.
bool is_clipped(const Vec& samples);

/// Whether a signal ascends from every sample to the next, 16 or more, as times and numbers of
/// samples do, and no probe of a vibration.
bool always_ascends(const Eigen::Ref<const Vec>& samples);

/// Samples that stand out alone: the steps into them and back are five times and more what 99 of
/// 100 steps are at most, and three times the standard deviation of the signal.
struct Spikes {
  Eigen::Index count = 0, first = 0;
};
Spikes spikes_in(const Vec& samples);

}  // namespace whirl::inline data
