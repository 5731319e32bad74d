#include "libdata/measured/simulated_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <random>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/random.hpp"
#include "libbase/numerics/statistics.hpp"

namespace whirl::inline data {

namespace {

constexpr double edge_samples = 4.0;   ///< that an edge of a pulse takes
constexpr double pulse_samples = 4.0;  ///< between its edges

void add_noise(Vec& samples, const ChannelNoise& noise, std::size_t channel) {
  if (noise.share == 0.0) return;
  const double deviation = standard_deviation(samples);
  std::seed_seq sequence{static_cast<std::uint32_t>(noise.seed),
                         static_cast<std::uint32_t>(noise.seed >> 32),
                         static_cast<std::uint32_t>(channel)};
  std::mt19937_64 random(sequence);
  for (double& sample : samples) sample += noise.share * deviation * random_normal(random);
}

Vec pulses_of(const Recording& recording, const KeyPhasor& key) {
  const double between = static_cast<double>(recording.samples) / key.pulses;
  constexpr double needed = 2.0 * (1.5 * edge_samples + pulse_samples);
  if (between < needed) {
    throw OptionError("samples", fmt::format("{} pulses of the key-phasor per revolution need "
                                             "{:.0f} samples or more, there are {}",
                                             key.pulses, key.pulses * needed, recording.samples));
  }
  Vec pulses(recording.eta.cols());
  for (Eigen::Index j = 0; j < pulses.size(); ++j) {
    // in samples behind the middle of the edge that counts; of the falling one, seen backward
    double behind = static_cast<double>(j) - key.angle / turn * recording.samples;
    if (key.slope == PulseEdge::falling) behind = -behind;
    behind -= between * std::floor(behind / between + 0.5);
    const double rise = 0.5 + behind / edge_samples;
    const double fall = rise - 1.0 - pulse_samples / edge_samples;
    pulses(j) = std::clamp(rise, 0.0, 1.0) - std::clamp(fall, 0.0, 1.0);
  }
  return pulses;
}

/// Places channels: those that are numbers there, others by their names in between.
class ChannelPlaces {
 public:
  explicit ChannelPlaces(const std::vector<std::string>& asked) {
    for (const std::string& name : asked) numbers_.push_back(number_in(name));
    for (const std::size_t n : numbers_) taken_.resize(std::max(taken_.size(), n), false);
    for (const std::size_t n : numbers_) {
      if (n > 0) taken_[n - 1] = true;
    }
  }
  std::size_t place(std::size_t i) {
    if (numbers_[i] > 0) return numbers_[i] - 1;
    const auto free = std::find(taken_.begin(), taken_.end(), false);
    const auto at = static_cast<std::size_t>(free - taken_.begin());
    if (at == taken_.size()) taken_.push_back(true);
    taken_[at] = true;
    return at;
  }

 private:
  /// 0: it is a name.
  static std::size_t number_in(const std::string& name) {
    constexpr std::size_t most = 1000;
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    return error == std::errc() && end == name.data() + name.size() && number <= most ? number : 0;
  }
  std::vector<std::size_t> numbers_;
  std::vector<bool> taken_;
};

MeasuredChannel channel_of(const MeasuredProbe& p) {
  switch (p.gain.of) {
    case ProbeGain::Of::voltage:
      return {p.channel, "V"};
    case ProbeGain::Of::number:
      return {p.channel, ""};
    default:
      return {p.channel, "m"};
  }
}

}  // namespace

MeasuredRecord simulated_record(const Run& run, const MeasurementSetup& setup,
                                const ChannelNoise& noise) {
  const Recording& recording = run.simulation.recording;
  std::vector<MeasuredChannel> channels;
  std::vector<Vec> signals;
  std::vector<std::string> names;
  for (const MeasuredProbe& p : setup.probes) {
    signals.push_back(p.gain.value * reading_of(run, p.probe));
    add_noise(signals.back(), noise, signals.size());
    channels.push_back(channel_of(p));
    names.push_back(p.channel);
  }
  if (const auto& key = setup.key_phasor) {
    signals.push_back(pulses_of(recording, *key) * 2.0 * key->threshold.value_or(0.5));
    channels.push_back({key->channel, ""});
    names.push_back(key->channel);
  }
  MeasuredRecord record{.rate = 1.0 / recording.spacing(), .start = recording.time(0)};
  ChannelPlaces places(names);
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < signals.size(); ++i) at.push_back(places.place(i));
  const std::size_t count = at.empty() ? 0 : *std::max_element(at.begin(), at.end()) + 1;
  record.samples.setZero(recording.eta.cols(), static_cast<Eigen::Index>(count));
  record.channels.resize(count, {"unused", ""});
  for (std::size_t i = 0; i < signals.size(); ++i) {
    record.channels[at[i]] = channels[i];
    record.samples.col(static_cast<Eigen::Index>(at[i])) = signals[i];
  }
  return record;
}

}  // namespace whirl::inline data
