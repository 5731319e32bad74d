/// Universal files of records: datasets 58 (text) and 58b (numbers as this processor has them).

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "libio/measured/record_formats.hpp"
#include "libio/measured/universal_format.hpp"

namespace whirl::inline io {

namespace {

using namespace universal;

/// Samples as this processor has them.
std::string bytes_of(const Vec& samples) {
  std::string bytes(static_cast<std::size_t>(samples.size()) * sizeof(double), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

/// The first record of a dataset 58b.
std::string binary_head(const Vec& samples) {
  constexpr long big_endian = 2, lines_before = 11;
  const bool is_little = std::endian::native == std::endian::little;
  return fmt::format("{:6}b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", 58,
                     is_little ? RecordCode::little_endian : big_endian, RecordCode::ieee,
                     lines_before, static_cast<std::size_t>(samples.size()) * sizeof(double), 0, 0,
                     0, 0);
}

/// Samples as lines of 80 columns.
std::string lines_of(const Vec& samples) {
  std::string text, line;
  for (Eigen::Index j = 0; j < samples.size(); ++j) {
    line += fmt::format("{:20.12E}", samples(j));
    if (line.size() < 80 && j + 1 < samples.size()) continue;
    text += fmt::format("{:<80}\n", line);
    line.clear();
  }
  return text;
}

void write_datasets(const std::filesystem::path& path, const MeasuredRecord& record,
                    Replaces replaces, bool is_binary) {
  std::string text = fmt::format("{}{:>14}\n", universal_record_head, 2);
  const auto add = [&](const std::string& line) { text += fmt::format("{:<80.80}\n", line); };
  add(fmt::format("{:25.17E}{:25.17E}{:25.17E}", 1.0, 1.0, 1.0));
  add(fmt::format("{:25.17E}", 273.15));
  text += fmt::format("{}\n", block_mark);
  const auto axis = [](long kind, const char* label, const std::string& unit) {
    return fmt::format("{:10}{:5}{:5}{:5} {:<20.20} {:<20.20}", kind, 0, 0, 0, label,
                       unit.empty() ? "NONE" : unit);
  };
  for (Eigen::Index c = 0; c < record.samples.cols(); ++c) {
    const MeasuredChannel& channel = record.channels[static_cast<std::size_t>(c)];
    const Vec samples = record.samples.col(c);
    text += fmt::format("{}\n", block_mark);
    add(is_binary ? binary_head(samples) : fmt::format("{:6}", 58));
    add(channel.name);
    add(fmt::format("{}{}", rate_mark, record.rate));
    for (int i = 0; i < 3; ++i) add("NONE");
    add(fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}", RecordCode::time_response,
                    c + 1, 0, 0, "NONE", 0, 0, "NONE", 0, 0));
    add(fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}", RecordCode::real_double,
                    samples.size(), 1, record.start, 1.0 / record.rate, 0.0));
    add(axis(RecordCode::time, "Time", "s"));
    add(axis(channel.unit == "m" ? RecordCode::displacement : 0, "Signal", channel.unit));
    add(axis(0, "NONE", ""));
    add(axis(0, "NONE", ""));
    text += is_binary ? bytes_of(samples) : lines_of(samples);
    text += fmt::format("{}\n", block_mark);
  }
  replace_file(path, text, replaces_own(path, universal_record_head, replaces));
}

}  // namespace

void write_universal_record(const std::filesystem::path& path, const MeasuredRecord& record,
                            Replaces replaces) {
  write_datasets(path, record, replaces, false);
}

void write_binary_universal_record(const std::filesystem::path& path, const MeasuredRecord& record,
                                   Replaces replaces) {
  write_datasets(path, record, replaces, true);
}

}  // namespace whirl::inline io
