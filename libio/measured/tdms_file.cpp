#include "libio/measured/tdms_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "libbase/error.hpp"
#include "libio/measured/tdms_bytes.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t lead_in_bytes = 28;
constexpr std::uint64_t not_known = ~std::uint64_t{0};  ///< the size of a segment of a killed run

/// What a segment has.
enum Contents : std::uint32_t {
  has_metadata = 1u << 1u,
  has_new_list = 1u << 2u,
  has_raw_data = 1u << 3u,
  is_interleaved = 1u << 5u,
  is_big_endian = 1u << 6u,
  has_daqmx_data = 1u << 7u
};

/// What stands before the raw data index of an object: its size, or what it is instead.
enum IndexKind : std::uint32_t {
  same_index = 0,
  number_index = 20,
  text_index = 28,
  daqmx_format = 0x1269,
  daqmx_lines = 0x1369,
  no_data = 0xFFFFFFFFu
};

/// How a channel's samples stand in a chunk of raw data.
struct RawIndex {
  std::uint32_t type = 0;
  std::uint64_t count = 0;
  std::uint64_t bytes = 0;  ///< of all
};

/// What is known of an object beside what the file says of it.
struct ObjectState {
  std::optional<RawIndex> index{};  ///< the last one that it had
  std::size_t list = 0;             ///< in which list of objects it stands, from 1
  std::size_t place = 0;            ///< in that list
  std::optional<std::pair<std::int64_t, double>> first_time{};
};

/// A segment, as its lead-in has it.
struct Segment {
  std::size_t number = 0, begin = 0;
  std::uint32_t contents = 0;
  std::string_view metadata, raw;
  bool is_whole = true;
};

/// What samples of a segment leave.
struct RawRest {
  std::size_t bytes = 0;
  bool is_part = false;  ///< the last chunk, or row, is not whole
};

/// Names of "/'group'/'it''s'".
std::optional<std::vector<std::string>> names_of(std::string_view path) {
  std::vector<std::string> names;
  if (path == "/") return names;
  while (!path.empty()) {
    if (!path.starts_with("/'")) return std::nullopt;
    path.remove_prefix(2);
    std::string& name = names.emplace_back();
    while (true) {
      const auto quote = path.find('\'');
      if (quote == std::string_view::npos) return std::nullopt;
      name += path.substr(0, quote);
      path.remove_prefix(quote + 1);
      if (!path.starts_with('\'')) break;
      name += '\'';
      path.remove_prefix(1);
    }
  }
  return names;
}

/// Whether a property says something of samples.
bool is_of_use(std::string_view name) {
  return name.starts_with("wf_") || name.starts_with("NI_Scal") || name == "unit_string" ||
         name == "NI_Number_Of_Scales" || name == "NI_UnitDescription";
}

/// Channels have numbers or times, not both.
void require_kind(TdmsObject& object, bool is_time) {
  if (object.samples.empty()) object.is_time = is_time;
  if (object.is_time != is_time) object.no_samples = "it has numbers and times";
}

class TdmsReader {
 public:
  TdmsReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  TdmsFile read() {
    if (!bytes_.starts_with("TDSm")) {
      throw ModelError({file_}, "", "is no TDMS file: expected TDSm at its begin");
    }
    std::size_t at = 0;
    for (std::size_t number = 1; at < bytes_.size(); ++number) {
      const auto segment = segment_at(at, number);
      if (!segment) break;
      if (!take_metadata(*segment)) break;
      take_raw_data(*segment);
      if (!segment->is_whole) break;
      at = segment->begin + lead_in_bytes + segment->metadata.size() + segment->raw.size();
    }
    return std::move(found_);
  }

 private:
  [[noreturn]] void fail(const Segment& segment, const std::string& why) const {
    throw ModelError({file_}, "",
                     fmt::format("segment {}, at byte {}: {}", segment.number, segment.begin, why));
  }

  void note_cut(const Segment& segment, const std::string& what) {
    found_.notes.push_back(fmt::format("segment {} is not whole, as of a run that was killed: {}",
                                       segment.number, what));
  }

  /// @return  nothing: its lead-in is cut off
  std::optional<Segment> segment_at(std::size_t at, std::size_t number) {
    Segment segment{.number = number, .begin = at};
    const std::string_view rest = bytes_.substr(at);
    if (rest.size() < lead_in_bytes) {
      if (number == 1) fail(segment, "is cut off");
      note_cut(segment, fmt::format("its {} bytes are left out", rest.size()));
      return std::nullopt;
    }
    if (!rest.starts_with("TDSm")) fail(segment, "expected TDSm at its begin: the file is damaged");
    segment.contents = TdmsBytes(rest.substr(4), false).number<std::uint32_t>();
    TdmsBytes lead(rest.substr(12, 16), (segment.contents & is_big_endian) != 0);
    const auto size = lead.number<std::uint64_t>(), metadata = lead.number<std::uint64_t>();
    const std::string_view content = rest.substr(lead_in_bytes);
    segment.is_whole = size != not_known && size <= content.size();
    if (segment.is_whole && metadata > size) {
      fail(segment, fmt::format("its metadata has {} bytes, all of it {}", metadata, size));
    }
    const std::string_view all = segment.is_whole ? content.substr(0, size) : content;
    segment.metadata = all.substr(0, metadata);
    segment.raw = all.substr(segment.metadata.size());
    return segment;
  }

  /// @return  false: the metadata of a last segment is cut off
  bool take_metadata(const Segment& segment) {
    if ((segment.contents & has_daqmx_data) != 0) refuse_daqmx(segment);
    if ((segment.contents & has_new_list) != 0) {
      active_.clear();
      ++list_;
      places_ = 0;
      chunk_bytes_ = 0;
    }
    if ((segment.contents & has_metadata) == 0) return true;
    try {
      TdmsBytes bytes(segment.metadata, (segment.contents & is_big_endian) != 0);
      for (auto left = bytes.number<std::uint32_t>(); left > 0; --left) take_object(bytes, segment);
    } catch (const TdmsCutOff&) {
      if (segment.is_whole) fail(segment, "its metadata is cut off: the file is damaged");
      if (segment.number == 1) fail(segment, "its metadata is cut off");
      note_cut(segment, "its metadata is cut off, and it is left out");
      return false;
    }
    return true;
  }

  [[noreturn]] void refuse_daqmx(const Segment& segment) const {
    fail(
        segment,
        "has raw data as DAQmx logs them, which only NI's software reads: expected plain channels, "
        "as LabVIEW's \"TDMS Write\" or DIAdem save them");
  }

  void take_object(TdmsBytes& bytes, const Segment& segment) {
    const std::string path = bytes.text();
    const auto [known, is_new] = numbers_.try_emplace(path, found_.objects.size());
    const std::size_t number = known->second;
    if (is_new) {
      const auto names = names_of(path);
      if (!names || names->size() > 2) {
        fail(segment,
             fmt::format("found the path {:?}, expected one such as /'group'/'channel'", path));
      }
      found_.objects.push_back({*names});
      states_.emplace_back();
    }
    ObjectState& state = states_[number];
    const auto kind = bytes.number<std::uint32_t>();
    if (kind == daqmx_format || kind == daqmx_lines) refuse_daqmx(segment);
    remove(number);
    if (kind == same_index && !state.index) {
      fail(segment,
           fmt::format("the samples of {} are as before, and there were none before", path));
    }
    if (kind != same_index && kind != no_data) state.index = index_in(bytes, kind, path, segment);
    if (kind != no_data && state.index->bytes > 0) put(number);
    for (auto left = bytes.number<std::uint32_t>(); left > 0; --left) {
      take_property(bytes, found_.objects[number]);
    }
  }

  /// @param size  that it says to have
  RawIndex index_in(TdmsBytes& bytes, std::uint32_t size, const std::string& path,
                    const Segment& segment) const {
    RawIndex index;
    if (size != number_index && size != text_index) {
      fail(segment, fmt::format("{} has a raw data index of {} bytes, expected {} or {}", path,
                                size, std::uint32_t{number_index}, std::uint32_t{text_index}));
    }
    index.type = bytes.number<std::uint32_t>();
    const auto dimension = bytes.number<std::uint32_t>();
    index.count = bytes.number<std::uint64_t>();
    if (dimension != 1) {
      fail(segment, fmt::format("{} has samples of {} dimensions, expected 1", path, dimension));
    }
    if (index.type == tdms_text) {
      index.bytes = bytes.number<std::uint64_t>();
      return index;
    }
    const std::size_t each = tdms_size(index.type);
    if (each == 0) {
      fail(segment, fmt::format("{} has samples of type {:#x}, expected whole or real numbers of 8 "
                                "to 64 bits",
                                path, index.type));
    }
    if (__builtin_mul_overflow(index.count, each, &index.bytes)) index.bytes = not_known;
    return index;
  }

  /// Takes an object out of what has samples in the chunks that follow.
  void remove(std::size_t number) {
    const ObjectState& state = states_[number];
    if (state.list != list_ || active_.erase(state.place) == 0) return;
    chunk_bytes_ = 0;
  }

  void put(std::size_t number) {
    ObjectState& state = states_[number];
    if (state.list != list_) {
      state.list = list_;
      state.place = places_++;
    }
    active_.emplace(state.place, number);
    chunk_bytes_ = 0;
  }

  void take_property(TdmsBytes& bytes, TdmsObject& object) {
    const std::string name = bytes.text();
    const auto type = bytes.number<std::uint32_t>();
    TdmsValue value;
    if (type == tdms_text) {
      value.kind = TdmsValue::Kind::text;
      value.text = bytes.text();
    } else if (type == tdms_time) {
      value.kind = TdmsValue::Kind::time;
      std::tie(value.seconds, value.number) = bytes.time();
    } else if (is_tdms_number(type)) {
      value.number = tdms_number(bytes, type);
    } else if (tdms_size(type) > 0) {
      bytes.take(tdms_size(type));
      return;
    } else {
      throw ModelError({file_}, name,
                       fmt::format("is a property of type {:#x}, whose size is not known", type));
    }
    if (!is_of_use(name)) return;
    // what changes within a channel would be wrong for one part of it
    const auto [known, is_new] = object.properties.try_emplace(name, value);
    const bool is_same = known->second.number == value.number && known->second.text == value.text;
    if (!is_new && !is_same && !object.samples.empty() && !name.starts_with("wf_s")) {
      object.no_samples = fmt::format("its {} changes within the file", name);
    }
    known->second = std::move(value);
  }

  void take_raw_data(const Segment& segment) {
    if ((segment.contents & has_raw_data) == 0 || segment.raw.empty()) return;
    if (active_.empty()) fail(segment, "has samples, and no object says of which channel");
    const bool is_mixed = (segment.contents & is_interleaved) != 0;
    const RawRest rest = is_mixed ? take_rows(segment) : take_chunks(segment);
    if (!rest.is_part && segment.is_whole) return;
    const std::size_t end =
        segment.begin + lead_in_bytes + segment.metadata.size() + segment.raw.size();
    if (segment.is_whole && end < bytes_.size()) {
      fail(segment, fmt::format("its samples take {} bytes, which are no whole number of samples "
                                "of its channels: the file is damaged",
                                segment.raw.size()));
    }
    note_cut(segment, rest.bytes == 0 ? "its samples are taken as far as they are there"
                                      : fmt::format("its last {} bytes, which are no whole sample "
                                                    "of each channel, are left out",
                                                    rest.bytes));
  }

  /// Takes rows of one sample of each channel.
  RawRest take_rows(const Segment& segment) {
    std::size_t row = 0;
    for (const auto& [place, number] : active_) {
      const RawIndex& index = *states_[number].index;
      if (index.type == tdms_text) fail(segment, "has texts between samples, which have no size");
      row += tdms_size(index.type);
    }
    TdmsBytes bytes(segment.raw, (segment.contents & is_big_endian) != 0);
    while (bytes.left() >= row) {
      for (const auto& [place, number] : active_) take_samples(bytes, number, 1);
    }
    return {bytes.left(), bytes.left() > 0};
  }

  /// Takes chunks of all samples of one channel after the other.
  RawRest take_chunks(const Segment& segment) {
    if (chunk_bytes_ == 0) {
      for (const auto& [place, number] : active_) {
        const std::uint64_t bytes = states_[number].index->bytes;
        if (__builtin_add_overflow(chunk_bytes_, bytes, &chunk_bytes_)) chunk_bytes_ = not_known;
        if (chunk_bytes_ == not_known) break;
      }
    }
    TdmsBytes bytes(segment.raw, (segment.contents & is_big_endian) != 0);
    while (bytes.left() >= chunk_bytes_) {
      for (const auto& [place, number] : active_) {
        const RawIndex& index = *states_[number].index;
        TdmsBytes own(bytes.take(index.bytes), (segment.contents & is_big_endian) != 0);
        take_samples(own, number, index.count);
      }
    }
    if (bytes.left() == 0) return {};
    return {take_part_of_chunk(bytes.take(bytes.left()), segment), true};
  }

  /// Takes the samples that all channels have in a chunk that is cut off.
  /// @return  bytes that are left
  std::size_t take_part_of_chunk(std::string_view rest, const Segment& segment) {
    const std::uint64_t count = states_[active_.begin()->second].index->count;
    std::uint64_t common = count, at = 0;
    for (const auto& [place, number] : active_) {
      const RawIndex& index = *states_[number].index;
      const std::size_t size = tdms_size(index.type);
      const std::uint64_t there = at < rest.size() && size > 0 ? (rest.size() - at) / size : 0;
      common = index.count == count ? std::min(common, there) : 0;
      if (common == 0) return rest.size();
      at += index.bytes;  // of those before the last one, which are there
    }
    std::size_t taken = 0;
    at = 0;
    for (const auto& [place, number] : active_) {
      const RawIndex& index = *states_[number].index;
      TdmsBytes own(rest.substr(at), (segment.contents & is_big_endian) != 0);
      take_samples(own, number, common);
      taken += common * tdms_size(index.type);
      at += index.bytes;
    }
    return rest.size() - taken;
  }

  void take_samples(TdmsBytes& bytes, std::size_t number, std::uint64_t count) {
    TdmsObject& object = found_.objects[number];
    ObjectState& state = states_[number];
    const std::uint32_t type = state.index->type;
    if (is_tdms_number(type)) {
      require_kind(object, false);
      for (std::uint64_t j = 0; j < count; ++j) object.samples.push_back(tdms_number(bytes, type));
    } else if (type == tdms_time) {
      require_kind(object, true);
      for (std::uint64_t j = 0; j < count; ++j) {
        const auto [seconds, part] = bytes.time();
        if (!state.first_time) state.first_time = {seconds, part};
        object.samples.push_back(static_cast<double>(seconds) -
                                 static_cast<double>(state.first_time->first) +
                                 (part - state.first_time->second));
      }
    } else {
      object.no_samples = type == tdms_text ? "its samples are texts" : "its samples are complex";
      if (type != tdms_text) bytes.take(count * tdms_size(type));
    }
  }

  std::string_view bytes_;
  const std::string& file_;
  TdmsFile found_;
  std::vector<ObjectState> states_;  ///< of each object
  std::map<std::string, std::size_t> numbers_;
  std::map<std::size_t, std::size_t>
      active_;  ///< objects with samples, by their places in the list
  std::size_t list_ = 1, places_ = 0;
  std::uint64_t chunk_bytes_ = 0;  ///< of active objects; 0: not counted yet
};

}  // namespace

std::optional<double> number_in(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end() || found->second.kind != TdmsValue::Kind::number) return {};
  return found->second.number;
}

std::string text_in(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  return found == properties.end() ? "" : found->second.text;
}

TdmsFile tdms_file(std::string_view bytes, const std::string& file) {
  return TdmsReader(bytes, file).read();
}

}  // namespace whirl::inline io
