/// TDMS files of National Instruments: channels in groups, with their scales, units and times.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "libio/measured/channel_unit.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/measured/tdms_file.hpp"
#include "libio/measured/tdms_scale.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr int most_named = 12;  ///< channels that a note names

/// Makes a record of the objects of a file.
class TdmsRecord {
 public:
  TdmsRecord(TdmsFile file, const std::string& name) : objects_(std::move(file.objects)) {
    raw_.file = name;
    raw_.notes = std::move(file.notes);
    for (const TdmsObject& object : objects_) {
      if (object.names.size() == 2) ++alike_[object.names[1]];
      if (object.names.size() < 2) {
        above_[object.names.empty() ? std::nullopt : std::optional(object.names[0])] = &object;
      }
    }
  }

  RawRecord read() {
    for (TdmsObject& object : objects_) {
      if (object.names.size() != 2) continue;
      const std::string why = add(object);
      if (!why.empty()) leave_out(object, why);
    }
    tell_left_out();
    if (!doubtful_.empty()) {
      raw_.notes.push_back(fmt::format(
          "nothing says whether the samples of {} are scaled already (NI_Scaling_Status): they are "
          "taken as not, and multiplied by their NI_Scale",
          doubtful_));
    }
    if (raw_.channels.empty()) {
      throw ModelError({raw_.file}, "",
                       raw_.left_out.empty()
                           ? "has no channels with samples"
                           : fmt::format("has no channel that can be read: {}: {}",
                                         raw_.left_out.front().name, raw_.left_out.front().why));
    }
    if (raw_.no_rate_because.empty()) raw_.no_rate_because = "no channel has a wf_increment";
    return std::move(raw_);
  }

 private:
  /// @return  why it is left out; empty: it is a channel of the record
  std::string add(TdmsObject& object) {
    if (!object.no_samples.empty()) return object.no_samples;
    if (object.samples.empty()) return "it has no samples";
    RawChannel channel;
    channel.path = object.names[0] + "/" + object.names[1];
    channel.name = alike_.at(object.names[1]) == 1 ? object.names[1] : channel.path;
    channel.where = {raw_.file};
    if (object.is_time) {
      channel.unit = "s";
    } else {
      const auto unit = unit_of(object);
      if (!unit) return unit.problem;
      channel.unit = *unit;
      const auto clock = clock_of(object);
      if (!clock) return clock.problem;
      if (*clock >= 0) channel.clock = *clock;
      const std::string problem = scale(object, channel.name);
      if (!problem.empty()) return problem;
    }
    channel.samples = std::move(object.samples);
    raw_.channels.push_back(std::move(channel));
    return "";
  }

  static Parsed<std::string> unit_of(const TdmsObject& object) {
    const std::string unit = text_in(object.properties, "unit_string");
    const std::string other = text_in(object.properties, "NI_UnitDescription");
    if (unit.empty()) return other;
    const ChannelUnit known = channel_unit(unit), known_other = channel_unit(other);
    const auto is_scaled = [](const ChannelUnit& u) { return u.name == "m" || u.name == "V"; };
    const bool are_same = known.name == known_other.name && known.factor == known_other.factor;
    if (is_scaled(known) && is_scaled(known_other) && !are_same) {
      return Parsed<std::string>::failed(
          fmt::format("its unit_string is \"{}\", its NI_UnitDescription \"{}\"", unit, other));
    }
    return is_scaled(known_other) && !is_scaled(known) ? other : unit;
  }

  /// Number of the clock of a channel; -1: it has none.
  Parsed<int> clock_of(const TdmsObject& object) {
    const auto step = number_in(object.properties, "wf_increment");
    if (!step) return -1;
    const std::string unit = text_in(object.properties, "wf_xunit_string");
    const auto seconds = seconds_in(unit);
    if (!seconds) {
      return Parsed<int>::failed(
          fmt::format("its samples are in steps of \"{}\", expected steps of time", unit));
    }
    if (!(*step > 0.0) || !std::isfinite(*step)) {
      return Parsed<int>::failed(fmt::format("its wf_increment is {}", *step));
    }
    if (*step == 1.0) {
      raw_.no_rate_because =
          "wf_increment is 1, which LabVIEW writes where it does not know the rate, too";
      return -1;
    }
    const double start = *seconds * number_in(object.properties, "wf_start_offset").value_or(0.0) +
                         since_first(object);
    if (!std::isfinite(start)) return Parsed<int>::failed("its wf_start_offset is no number");
    const double rate = 1.0 / (*seconds * *step), within = even_to / rate;
    const auto known = clocks_.lower_bound({rate, start - within});
    if (known != clocks_.end() && known->first.first == rate &&
        known->first.second <= start + within) {
      return known->second;
    }
    const int number = static_cast<int>(raw_.clocks.size());
    clocks_[{rate, start}] = number;
    raw_.clocks.push_back({.rate = rate, .start = start});
    return number;
  }

  /// Seconds from the wf_start_time of the first channel that has one.
  double since_first(const TdmsObject& object) {
    const auto found = object.properties.find("wf_start_time");
    if (found == object.properties.end() || found->second.kind != TdmsValue::Kind::time) return 0.0;
    const TdmsValue& time = found->second;
    if (!first_) first_ = time;
    return static_cast<double>(time.seconds) - static_cast<double>(first_->seconds) +
           (time.number - first_->number);
  }

  /// @return  what is wrong with its scale; empty: its samples are scaled
  std::string scale(TdmsObject& object, const std::string& name) {
    // that of the channel, or else of its group, or of the file
    const TdmsObject* by = &object;
    for (const auto& level : {std::optional(object.names[0]), std::optional<std::string>()}) {
      if (has_tdms_scale(by->properties)) break;
      const auto above = above_.find(level);
      if (above != above_.end()) by = above->second;
    }
    if (!has_tdms_scale(by->properties)) return "";
    const auto scale = tdms_scale(by->properties);
    if (!scale) return scale.problem;
    if (scale->is_doubtful) doubtful_ += (doubtful_.empty() ? "" : ", ") + name;
    for (double& sample : object.samples) sample = (*scale)(sample);
    return "";
  }

  void leave_out(const TdmsObject& object, const std::string& why) {
    const std::string path = object.names[0] + "/" + object.names[1];
    if (alike_.at(object.names[1]) == 1) raw_.left_out.push_back({object.names[1], why});
    raw_.left_out.push_back({path, why});
    auto& [count, names] = reasons_[why];
    if (++count > most_named) return;
    names += (names.empty() ? "" : ", ") + path;
  }

  void tell_left_out() {
    for (const auto& [why, channels] : reasons_) {
      const auto& [count, names] = channels;
      raw_.notes.push_back(fmt::format(
          "left out: {}{}: {}", names,
          count > most_named ? fmt::format(" and {} more", count - most_named) : "", why));
    }
  }

  std::vector<TdmsObject> objects_;
  RawRecord raw_;
  std::map<std::string, int> alike_;                               ///< channels of each name
  std::map<std::optional<std::string>, const TdmsObject*> above_;  ///< groups, and the file
  std::map<std::pair<double, double>, int> clocks_;                ///< by rate and start
  std::optional<TdmsValue> first_;                                 ///< wf_start_time
  std::string doubtful_;  ///< channels of which nothing says whether they are scaled
  std::map<std::string, std::pair<int, std::string>> reasons_;
};

}  // namespace

RawRecord read_tdms_record(const std::filesystem::path& path) {
  const std::string bytes = record_bytes(path);
  return TdmsRecord(tdms_file(bytes, path.string()), path.string()).read();
}

}  // namespace whirl::inline io
