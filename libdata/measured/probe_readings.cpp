#include "libdata/measured/probe_readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libbase/error.hpp"

namespace whirl::inline data {

namespace {

/// What a file says of a channel that is not in the record that is read; empty: nothing.
std::string elsewhere(const MeasuredRecord& all, const std::string& channel) {
  const auto has_name = [&](const MeasuredChannel& c) { return c.is_called(channel); };
  for (const ChannelLeftOut& c : all.left_out) {
    if (c.name == channel) return fmt::format("channel \"{}\" was left out: {}", channel, c.why);
  }
  for (const MeasuredRecord& other : all.others) {
    if (std::none_of(other.channels.begin(), other.channels.end(), has_name)) continue;
    return fmt::format(
        "channel \"{}\" has {} samples at {:.6g} per second, other channels of the probes {} at "
        "{:.6g}: all have to be of one length and rate",
        channel, other.samples.rows(), other.rate, all.samples.rows(), all.rate);
  }
  return "";
}

/// The record that has all channels of a setup by their names, else the first one.
const MeasuredRecord& record_for(const MeasuredRecord& all, const MeasurementSetup& setup) {
  std::vector<std::string> names;
  for (const MeasuredProbe& p : setup.probes) names.push_back(p.channel);
  if (setup.key_phasor) names.push_back(setup.key_phasor->channel);
  const auto has_all = [&](const MeasuredRecord& record) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::any_of(record.channels.begin(), record.channels.end(),
                         [&](const MeasuredChannel& c) { return c.is_called(name); });
    });
  };
  if (has_all(all)) return all;
  const auto other = std::find_if(all.others.begin(), all.others.end(), has_all);
  return other == all.others.end() ? all : *other;
}

Eigen::Index channel_of(const MeasuredRecord& record, const std::string& channel,
                        const std::string& who) {
  const auto alike = std::count_if(record.channels.begin(), record.channels.end(),
                                   [&](const MeasuredChannel& c) { return c.is_called(channel); });
  if (alike > 1) {
    throw OptionError(fmt::format(
        "{}: {} channels of the record are called \"{}\": give its number from 1; it has {}", who,
        alike, channel, record.channel_list()));
  }
  if (const auto found = record.channel(channel)) return *found;
  const std::string why = elsewhere(record, channel);
  if (!why.empty()) throw OptionError(fmt::format("{}: {}", who, why));
  throw OptionError(fmt::format("{}: the record has no channel \"{}\"; it has {}", who, channel,
                                record.channel_list()));
}

/// How many metres a unit of a channel's samples stands for.
double metres_per_unit(const MeasuredChannel& channel, const MeasuredProbe& p) {
  using Of = ProbeGain::Of;
  const std::string who = fmt::format("probe \"{}\"", p.probe.name);
  const auto wrong = [&](const char* expected) {
    return OptionError(fmt::format("{}: channel \"{}\" is in {}, expected {}", who, channel.name,
                                   channel.unit, expected));
  };
  if (channel.unit == share_of_full_scale) {
    if (p.gain.of == Of::number) return metres_per_unit({channel.name, ""}, p);
    if (p.full_scale) {
      return p.full_scale->value * metres_per_unit({channel.name, p.full_scale->unit}, p);
    }
    throw OptionError(fmt::format(
        "{}: samples of channel \"{}\" are shares of full scale, as in files of sound, which do "
        "not say what that is: give full_scale = \"10 V\", or what the recorder was set to, beside "
        "the "
        "gain of the probe or above all probes; only a gain of numbers, such as \"0.787 1/mm\", "
        "needs none",
        who, channel.name));
  }
  switch (p.gain.of) {
    case Of::voltage:
      if (!channel.unit.empty() && channel.unit != "V") {
        throw wrong("a voltage, as its gain is one per displacement");
      }
      return 1.0 / p.gain.value;
    case Of::number:
      if (!channel.unit.empty()) throw wrong("numbers without unit, as its gain is per length");
      return 1.0 / p.gain.value;
    default:
      if (channel.unit.empty()) return p.unit_length / p.gain.value;
      if (channel.unit == "V") throw wrong("a length; give the probe a gain such as \"7.87 V/mm\"");
      if (channel.unit != "m")
        throw wrong("a length or, with a gain such as \"7.87 V/mm\", a voltage");
      return 1.0 / p.gain.value;
  }
}

/// Notes that a channel says nothing, or less or more than it should.
void note_channel(const Vec& samples, const MeasuredRecord& record, const std::string& name,
                  std::vector<std::string>& notes) {
  if (samples.size() > 0 && samples.maxCoeff() == samples.minCoeff()) {
    notes.push_back(fmt::format("channel \"{}\" is constant: is its probe connected?", name));
  } else if (always_ascends(samples)) {
    notes.push_back(fmt::format(
        "channel \"{}\" ascends from every sample to the next, as times do and no vibration does: "
        "is it that of the probe?",
        name));
  } else if (is_clipped(samples)) {
    notes.push_back(fmt::format(
        "channel \"{}\" is clipped: it rests at its largest or smallest value; amplitudes are too "
        "small and harmonics are not the motion's",
        name));
  }
  if (const Spikes spikes = spikes_in(samples); spikes.count > 0) {
    notes.push_back(fmt::format(
        "channel \"{}\" has {} of one sample, the first at {:.6g} s: spectra are too high "
        "everywhere; leave such samples empty",
        name, spikes.count == 1 ? "a spike" : fmt::format("{} spikes", spikes.count),
        record.time(spikes.first)));
  }
}

/// Notes displacements that no rotor makes: a unit or a gain is another one.
void note_size(const Vec& displacement, const std::string& probe, std::vector<std::string>& notes) {
  constexpr double most = 0.1;  // [m]
  if (displacement.size() == 0) return;
  const double range = displacement.maxCoeff() - displacement.minCoeff();
  if (!(range > most)) return;
  notes.push_back(
      fmt::format("probe \"{}\" reads {:.3g} m from peak to peak: are the unit and the gain right?",
                  probe, range));
}

/// Notes channels whose numbers are in a unit that nobody said, and what it is taken to be.
void note_units(const MeasuredRecord& record, const MeasurementSetup& setup,
                const std::vector<Eigen::Index>& channels, std::vector<std::string>& notes) {
  using Of = ProbeGain::Of;
  std::map<std::string, std::string> without_unit;  // names by what they are
  for (std::size_t i = 0; i < setup.probes.size(); ++i) {
    const MeasuredProbe& p = setup.probes[i];
    const MeasuredChannel& channel = record.channels[static_cast<std::size_t>(channels[i])];
    if (p.gain.of == Of::number || !channel.unit.empty()) continue;
    if (p.gain.of == Of::length && p.is_unit_given) continue;
    std::string& names = without_unit[p.gain.of == Of::voltage ? "V" : p.probe.unit];
    names += (names.empty() ? "" : ", ") + channel.name;
  }
  for (const auto& [unit, names] : without_unit) {
    notes.push_back(fmt::format("no unit in the record for {}: taken as {}", names, unit));
  }
}

/// A key-phasor with its threshold in the numbers of its channel.
KeyPhasor in_numbers_of(const MeasuredChannel& channel, KeyPhasor key) {
  const std::string& unit = key.threshold_unit;
  if (!key.threshold || unit.empty() || channel.unit.empty() || channel.unit == unit) return key;
  const std::string who = fmt::format("key-phasor: channel \"{}\"", channel.name);
  if (channel.unit != share_of_full_scale) {
    throw OptionError(fmt::format("{} is in {}, and its threshold in {}", who, channel.unit, unit));
  }
  if (!key.full_scale || key.full_scale->unit != unit) {
    throw OptionError(fmt::format(
        "{} has shares of full scale, and its threshold is in {}: give full_scale = \"10 V\", or "
        "what the recorder was set to, in [keyphasor] or above all probes, or leave the threshold "
        "out",
        who, unit));
  }
  *key.threshold /= key.full_scale->value;
  return key;
}

}  // namespace

ProbeReadings probe_readings(const MeasuredRecord& all, const MeasurementSetup& setup) {
  const MeasuredRecord& record = record_for(all, setup);
  ProbeReadings readings{.rate = record.rate, .start = record.start, .notes = record.notes};
  readings.displacement.resize(record.samples.rows(), std::ssize(setup.probes));
  std::vector<Eigen::Index> channels;
  std::vector<Gaps> gaps;
  for (std::size_t i = 0; i < setup.probes.size(); ++i) {
    const MeasuredProbe& p = setup.probes[i];
    const auto c = channel_of(record, p.channel, fmt::format("probe \"{}\"", p.probe.name));
    const MeasuredChannel& channel = record.channels[static_cast<std::size_t>(c)];
    for (std::size_t j = 0; j < i; ++j) {
      const Vec other = record.samples.col(channels[j]);
      if (channels[j] != c && other != record.samples.col(c)) continue;
      readings.notes.push_back(fmt::format("probes \"{}\" and \"{}\" read the same samples",
                                           setup.probes[j].probe.name, p.probe.name));
    }
    channels.push_back(c);
    const Vec samples = without_gaps(record.samples.col(c), record, channel.name, gaps);
    readings.missing.emplace_back();
    for (Eigen::Index k = 0; k < samples.size(); ++k) {
      if (!std::isfinite(record.samples(k, c))) readings.missing.back().push_back(k);
    }
    note_channel(samples, record, channel.name, readings.notes);
    readings.displacement.col(static_cast<Eigen::Index>(i)) = metres_per_unit(channel, p) * samples;
    note_size(readings.displacement.col(static_cast<Eigen::Index>(i)), p.probe.name,
              readings.notes);
    readings.probes.push_back(p.probe);
  }
  note_units(record, setup, channels, readings.notes);
  Vec pulses;
  std::optional<KeyPhasor> key = setup.key_phasor;
  if (key) {
    const auto c = channel_of(record, key->channel, "key-phasor");
    key = in_numbers_of(record.channels[static_cast<std::size_t>(c)], *key);
    pulses = without_gaps(record.samples.col(c), record, key->channel, gaps);
  }
  for (const Gaps& g : gaps) {
    readings.notes.push_back(g.text(record) + "; straight lines are in their place");
  }
  if (key) {
    readings.clock.emplace(pulse_times(pulses, record, *key), *key, readings.notes);
  }
  return readings;
}

}  // namespace whirl::inline data
