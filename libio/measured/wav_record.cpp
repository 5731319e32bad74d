/// Sound files: chunks of RIFF, in the byte order of most processors. Those that this program
/// writes say in a comment what their channels are; samples of others are shares of full scale.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "libio/measured/record_formats.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they stand");

constexpr std::uint16_t wav_whole = 1, wav_real = 3, wav_extended = 0xFFFE;

/// How samples stand in a file.
struct WavForm {
  std::uint16_t kind = 0, channels = 0, bits = 0;
  std::uint32_t rate = 0;  ///< [1/s]

  std::size_t sample_size() const { return bits / 8u; }
};

template <class Number>
Number wav_number(std::string_view bytes, std::size_t at) {
  Number value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class Number>
void add_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A sample, of whole numbers with full scale 1.
double wav_sample(std::string_view bytes, std::size_t at, const WavForm& form) {
  if (form.kind == wav_real) {
    return form.bits == 64 ? wav_number<double>(bytes, at) : wav_number<float>(bytes, at);
  }
  if (form.bits == 8) return (static_cast<unsigned char>(bytes[at]) - 128.0) / 128.0;
  std::uint32_t value = 0;  // the most significant bytes
  std::memcpy(reinterpret_cast<char*>(&value) + (4 - form.sample_size()), bytes.data() + at,
              form.sample_size());
  return std::ldexp(static_cast<double>(static_cast<std::int32_t>(value)), -31);
}

WavForm wav_form(std::string_view chunk, const Where& where) {
  constexpr std::size_t plain_size = 16, extended_size = 26;
  if (chunk.size() < plain_size) throw ModelError(where, "", "its chunk fmt is cut off");
  WavForm form{wav_number<std::uint16_t>(chunk, 0), wav_number<std::uint16_t>(chunk, 2),
               wav_number<std::uint16_t>(chunk, 14), wav_number<std::uint32_t>(chunk, 4)};
  if (form.kind == wav_extended && chunk.size() >= extended_size) {
    form.kind = wav_number<std::uint16_t>(chunk, 24);
  }
  const bool is_whole = form.kind == wav_whole &&
                        (form.bits == 8 || form.bits == 16 || form.bits == 24 || form.bits == 32);
  const bool is_real = form.kind == wav_real && (form.bits == 32 || form.bits == 64);
  if (!is_whole && !is_real) {
    throw ModelError(where, "",
                     fmt::format("has format {} with {} bits, expected whole numbers (1) of 8, 16, "
                                 "24 or 32 bits or real ones (3) of 32 or 64",
                                 form.kind, form.bits));
  }
  if (form.channels == 0) throw ModelError(where, "", "has no channels");
  return form;
}

/// Begins the comment of files that this program writes.
constexpr std::string_view wav_comment = "whirl, samples as numbers of: ";

/// A chunk with its head and an even number of bytes.
std::string wav_chunk(std::string_view name, std::string_view content) {
  std::string bytes(name);
  add_number<std::uint32_t>(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += content;
  if (content.size() % 2 == 1) bytes += '\0';
  return bytes;
}

/// Names and units of channels from a chunk LIST of this program; none: it says none.
std::vector<MeasuredChannel> wav_channels(std::string_view list) {
  std::vector<MeasuredChannel> channels;
  if (!list.starts_with("INFOICMT") || list.size() < 12) return channels;
  std::string_view text = list.substr(12, wav_number<std::uint32_t>(list, 8));
  text = text.substr(0, text.find('\0'));
  if (!text.starts_with(wav_comment)) return channels;
  text.remove_prefix(wav_comment.size());
  for (const Cell& cell : cells_of(text, Delimiter::comma)) {
    const NameAndUnit said = name_and_unit(cell.text, [](auto&&, auto&&) { return false; });
    channels.push_back({said.name, said.unit});
  }
  return channels;
}

/// Real samples may be above full scale: then they may be no shares of it.
void note_above_full_scale(RawRecord& raw) {
  constexpr double most = 1.0 + 1e-6;  // rounded
  double largest = 0.0;
  for (const RawChannel& c : raw.channels) {
    for (const double sample : c.samples) largest = std::max(largest, std::abs(sample));
  }
  if (!(largest > most)) return;
  raw.notes.push_back(fmt::format("samples are up to {:.3g} times full scale: if they are volts "
                                  "already, full_scale = \"1 V\" says so",
                                  largest));
}

}  // namespace

RawRecord read_wav_record(const std::filesystem::path& path) {
  const std::string bytes = record_bytes(path);
  const std::string_view all = bytes;
  const Where where{path.string()};
  if (all.size() < 12 || all.substr(0, 4) != "RIFF" || all.substr(8, 4) != "WAVE") {
    throw ModelError(where, "", "is no WAV file: expected RIFF ... WAVE at its begin");
  }
  std::optional<WavForm> form;
  std::vector<MeasuredChannel> said;
  RawRecord raw{.file = path.string()};
  std::size_t at = 12;
  while (at + 8 <= all.size()) {
    const std::string_view name = all.substr(at, 4);
    const std::size_t size = wav_number<std::uint32_t>(all, at + 4);
    const std::string_view chunk = all.substr(at + 8, size);
    if (name == "fmt ") form = wav_form(chunk, where);
    if (name == "LIST") said = wav_channels(chunk);
    if (name == "data") {
      if (!form) throw ModelError(where, "", "has samples before the chunk fmt that says how");
      if (chunk.size() < size) {
        throw ModelError(
            where, "",
            fmt::format("is cut off: its samples take {} bytes, {} are there", size, chunk.size()));
      }
      const std::size_t frame = form->sample_size() * form->channels;
      const std::size_t count = chunk.size() / frame;
      if (count == 0) {
        throw ModelError(where, "",
                         fmt::format("has no samples: one of each channel takes {} bytes, {} are "
                                     "there",
                                     frame, chunk.size()));
      }
      for (std::size_t c = 0; c < form->channels; ++c) {
        RawChannel& channel = raw.channels.emplace_back();
        channel.name = said.size() == form->channels ? said[c].name : std::to_string(c + 1);
        channel.unit = said.size() == form->channels ? said[c].unit : share_of_full_scale;
        channel.where = where;
        channel.samples.resize(count);
        for (std::size_t j = 0; j < count; ++j) {
          channel.samples[j] = wav_sample(chunk, j * frame + c * form->sample_size(), *form);
        }
      }
      raw.rate = form->rate;
      if (said.size() != form->channels) note_above_full_scale(raw);
      return raw;
    }
    at += 8 + size + size % 2;
  }
  throw ModelError(where, "", "has no samples: there is no chunk data");
}

void write_wav_record(const std::filesystem::path& path, const MeasuredRecord& record,
                      Replaces replaces) {
  const double whole = std::round(record.rate);
  const auto channels = static_cast<std::size_t>(record.samples.cols());
  const auto frames = static_cast<std::size_t>(record.samples.rows());
  std::string comment(wav_comment);
  for (const MeasuredChannel& c : record.channels) {
    comment += (&c == record.channels.data() ? "" : ",") +
               csv_quoted(fmt::format("{} [{}]", c.name, c.unit));
  }
  const std::string about = "INFO" + wav_chunk("ICMT", comment + '\0');
  constexpr double most_bytes = 4e9;
  if (std::abs(record.rate / whole - 1.0) > 1e-9) {
    throw FileError(fmt::format(
        "cannot write {}: WAV takes whole numbers of samples per second only, these are {:.9g}; "
        "another ending takes any",
        path.string(), record.rate));
  }
  if (8.0 * static_cast<double>(channels) * static_cast<double>(frames) > most_bytes) {
    throw FileError(fmt::format("cannot write {}: WAV has 4 GB at most", path.string()));
  }
  std::string bytes = "RIFF";
  const std::size_t frame = 8 * channels;
  const auto data_size = static_cast<std::uint32_t>(frame * frames);
  const std::string list = wav_chunk("LIST", about);
  add_number<std::uint32_t>(bytes, 36 + static_cast<std::uint32_t>(list.size()) + data_size);
  bytes += "WAVEfmt ";
  add_number<std::uint32_t>(bytes, 16);
  add_number<std::uint16_t>(bytes, wav_real);
  add_number<std::uint16_t>(bytes, static_cast<std::uint16_t>(channels));
  add_number<std::uint32_t>(bytes, static_cast<std::uint32_t>(whole));
  add_number<std::uint32_t>(bytes, static_cast<std::uint32_t>(whole * static_cast<double>(frame)));
  add_number<std::uint16_t>(bytes, static_cast<std::uint16_t>(frame));
  add_number<std::uint16_t>(bytes, 64);
  bytes += list;
  bytes += "data";
  add_number<std::uint32_t>(bytes, data_size);
  for (Eigen::Index j = 0; j < record.samples.rows(); ++j) {
    for (Eigen::Index c = 0; c < record.samples.cols(); ++c)
      add_number(bytes, record.samples(j, c));
  }
  replace_file(path, bytes, replaces);
}

}  // namespace whirl::inline io
