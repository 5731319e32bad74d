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

/// What a sample of 1 is in a channel of shares of full scale.
struct FullScale {
  double value = 1.0;  ///< above zero
  std::string unit{};  ///< "V" or "m"
};

struct MeasuredChannel {
  std::string name;
  /// Unit of its samples: "m", "V", share_of_full_scale or any other; "": the file does not say it.
  std::string unit{};
  std::string path{};  ///< another name that it has, with those of its groups; "": none

  bool is_called(const std::string& other) const {
    return name == other || (!path.empty() && path == other);
  }
};

/// A channel of a file that is in no record, and why.
struct ChannelLeftOut {
  std::string name, why;
};

/// What was measured.
struct MeasuredRecord {
  double rate = 0.0;   ///< samples per second [1/s]
  double start = 0.0;  ///< time of the first one [s]
  std::vector<MeasuredChannel> channels;
  Mat samples;  ///< samples x channels; lengths in m, voltages in V; NaN: missing
  std::vector<std::string> notes{};  ///< what its reader took for granted, in words
  /// Channels of the same file with other lengths or times, which have no others.
  std::vector<MeasuredRecord> others{};
  std::vector<ChannelLeftOut> left_out{};

  double duration() const { return static_cast<double>(samples.rows()) / rate; }
  double time(Eigen::Index sample) const { return start + static_cast<double>(sample) / rate; }
  /// Names of the channels, for messages: "x [m], y [m]".
  std::string channel_list() const;
  /// The channel of a name or path, or if no channel has that, the channel of that number from 1.
  std::optional<Eigen::Index> channel(const std::string& name) const;
};

/// Share of the samples of a channel that may be missing.
constexpr double most_missing = 0.05;

/// Samples that are missing, and the channels that miss just these.
struct Gaps {
  std::vector<std::string> channels;
  std::vector<Eigen::Index> missing;  ///< one or more
  Eigen::Index samples = 0;           ///< of a channel

  /// Says how many samples are missing, and when the first one.
  std::string text(const MeasuredRecord& record) const;
};

/// Samples with straight lines where there is no number; at the ends with the next number.
Vec filled(const Vec& samples);

/// Fills missing samples of a channel by straight lines between their neighbors.
///
/// @param name  of the channel
/// @param gaps  of the channels before; receives those of this one
/// @throws OptionError  if more than a twentieth is missing
Vec without_gaps(const Vec& samples, const MeasuredRecord& record, const std::string& name,
                 std::vector<Gaps>& gaps);

/// Whether a signal was cut off: it rests at its largest or smallest value for three samples or
/// more, and leaves such rests by steps that are, on the average, more than twice its smallest
/// step. A coarsely digitized signal rests at its crests, too, but leaves them by its smallest
/// steps.
bool is_clipped(const Vec& samples);

/// Whether a signal of 16 samples or more ascends from every sample to the next, as times and
/// numbers of samples do, but no reading of a vibration.
bool always_ascends(const Eigen::Ref<const Vec>& samples);

/// Samples that stand out alone: the steps into such a sample and back are at least five times the
/// largest of the smaller 99 % of all steps, and three times the standard deviation of the signal.
struct Spikes {
  Eigen::Index count = 0, first = 0;
};
Spikes spikes_in(const Vec& samples);

}  // namespace whirl::inline data
