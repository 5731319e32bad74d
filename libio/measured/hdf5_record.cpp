/// HDF5: datasets of one length, at the root or in groups.

#include <fmt/format.h>

#include <algorithm>

#include "libio/measured/record_formats.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

namespace {

/// A dataset with its name below the root.
struct FoundDataset {
  std::string path, name;
  std::vector<Eigen::Index> shape;
};

std::vector<FoundDataset> numbers_in(const ResultReader& file) {
  std::vector<FoundDataset> found;
  for (const std::string& path : file.datasets()) {
    const ObjectKind kind = file.kind(path);
    if (kind != ObjectKind::real && kind != ObjectKind::integer) continue;
    found.push_back({path, path.substr(path.rfind('/') + 1), file.shape(path)});
  }
  return found;
}

std::string unit_of(const ResultReader& file, const std::string& path) {
  for (const char* name : {"units", "unit"}) {
    if (file.has_attribute(path, name)) return file.string_attribute(path, name);
  }
  return "";
}

/// Channels of a matrix: its columns, or rows where these are longer.
void add_channels(RawRecord& raw, const ResultReader& file, const FoundDataset& d) {
  const std::vector<double> numbers = file.numbers(d.path);
  const bool is_list = d.shape.size() == 1;
  const auto rows = static_cast<std::size_t>(d.shape[0]);
  const auto columns = is_list ? 1 : static_cast<std::size_t>(d.shape[1]);
  const bool is_upright = rows >= columns;
  const std::size_t count = std::min(rows, columns), n = std::max(rows, columns);
  const std::string unit = unit_of(file, d.path);
  for (std::size_t c = 0; c < (is_list ? 1 : count); ++c) {
    RawChannel& channel = raw.channels.emplace_back();
    channel.name = is_list || count == 1 ? d.name : fmt::format("{}({})", d.name, c + 1);
    channel.path = d.path.substr(1) + channel.name.substr(d.name.size());
    channel.unit = unit;
    channel.where = {raw.file};
    channel.samples.resize(is_list ? rows : n);
    for (std::size_t j = 0; j < channel.samples.size(); ++j) {
      channel.samples[j] = numbers[is_upright ? j * columns + c : c * columns + j];
    }
  }
}

}  // namespace

RawRecord read_hdf5_record(const std::filesystem::path& path) {
  const ResultReader file(path);
  RawRecord raw{.file = path.string()};
  for (const std::string& name : file.attributes("/")) {
    if (names_rate(name)) raw.rate = file.number_attribute("/", name);
    if (name == "start") raw.start = file.number_attribute("/", name);
  }
  for (const FoundDataset& d : numbers_in(file)) {
    Eigen::Index size = 1;
    for (const Eigen::Index n : d.shape) size *= n;
    if (size == 1 && names_rate(d.name)) {
      raw.rate = file.numbers(d.path).front();
    } else if (size == 1 && d.name == "start") {
      raw.start = file.numbers(d.path).front();
    } else if (size > 1 && d.shape.size() <= 2) {
      add_channels(raw, file, d);
    }
  }
  return raw;
}

void write_hdf5_record(const std::filesystem::path& path, const MeasuredRecord& record,
                       Replaces replaces) {
  ResultWriter file(path, replaces == Replaces::anything ? replaces : Replaces::own_results);
  file.attribute("/", "program", std::string("whirl"));
  file.attribute("/", "rate", record.rate);
  file.attribute("/", "start", record.start);
  for (Eigen::Index c = 0; c < record.samples.cols(); ++c) {
    const MeasuredChannel& channel = record.channels[static_cast<std::size_t>(c)];
    std::string name = channel.name;
    std::replace(name.begin(), name.end(), '/', '_');
    file.dataset("/" + name, Vec(record.samples.col(c)),
                 {channel.unit, "signal of a channel", {""}});
  }
  file.commit();
}

}  // namespace whirl::inline io
