/// MATLAB files: vectors, or a matrix with a channel per column, also in structs.

#include <fmt/format.h>

#include <algorithm>

#include "libbase/structs/travel.hpp"
#include "libio/measured/matlab_elements.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/results/confined_child.hpp"
#include "libio/results/matlab_variables.hpp"

namespace whirl::inline io {

namespace {

constexpr const char* matlab_record_head = "MATLAB 5.0 MAT-file, measurement, written by whirl";

std::size_t elements_of(const matvar_t& v) {
  return v.dims[0] * v.dims[1];
}

template <class Number>
std::vector<double> as_doubles(const matvar_t& v) {
  const auto* values = static_cast<const Number*>(v.data);
  return {values, values + elements_of(v)};
}

/// Numbers of a matrix, column by column; none: it is no matrix of real numbers.
std::vector<double> numbers_of(const matvar_t& v) {
  if (!v.data || v.rank != 2 || v.isComplex) return {};
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return as_doubles<double>(v);
    case MAT_C_SINGLE:
      return as_doubles<float>(v);
    case MAT_C_INT8:
      return as_doubles<std::int8_t>(v);
    case MAT_C_UINT8:
      return as_doubles<std::uint8_t>(v);
    case MAT_C_INT16:
      return as_doubles<std::int16_t>(v);
    case MAT_C_UINT16:
      return as_doubles<std::uint16_t>(v);
    case MAT_C_INT32:
      return as_doubles<std::int32_t>(v);
    case MAT_C_UINT32:
      return as_doubles<std::uint32_t>(v);
    case MAT_C_INT64:
      return as_doubles<std::int64_t>(v);
    case MAT_C_UINT64:
      return as_doubles<std::uint64_t>(v);
    default:
      return {};
  }
}

/// Rows of a matrix of characters, which stand column by column, or of cells of these.
std::vector<std::string> texts_of(const matvar_t& v) {
  if (v.data && v.class_type == MAT_C_CELL && v.rank == 2) {
    std::vector<std::string> all;
    const auto* cells = static_cast<matvar_t* const*>(v.data);
    for (std::size_t k = 0; k < elements_of(v); ++k) {
      const auto rows = cells[k] ? texts_of(*cells[k]) : std::vector<std::string>();
      all.push_back(rows.empty() ? "" : rows.front());
    }
    return all;
  }
  if (!v.data || v.class_type != MAT_C_CHAR || v.rank != 2) return {};
  const auto* bytes = static_cast<const char*>(v.data);
  const std::size_t count = elements_of(v), size = count > 0 ? v.nbytes / count : 0;
  if (size < 1 || size > 2) return {};
  std::vector<std::string> rows(v.dims[0]);
  for (std::size_t k = 0; k < count; ++k) rows[k % v.dims[0]] += bytes[k * size];
  for (std::string& row : rows) row.erase(row.find_last_not_of(' ') + 1);
  return rows;
}

/// The channels of a matrix: its columns, or rows where these are longer.
void add_channels(RawRecord& raw, const matvar_t& v, const std::string& name,
                  const std::vector<double>& numbers) {
  const bool is_upright = v.dims[0] >= v.dims[1];
  const std::size_t count = std::min(v.dims[0], v.dims[1]), n = std::max(v.dims[0], v.dims[1]);
  for (std::size_t c = 0; c < count; ++c) {
    RawChannel& channel = raw.channels.emplace_back();
    channel.name = count == 1 ? name : fmt::format("{}({})", name, c + 1);
    channel.where = {raw.file};
    channel.samples.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
      channel.samples[j] = numbers[is_upright ? c * n + j : j * count + c];
    }
  }
}

/// Whether a file can hold a variable: compressed a number takes some thousandths of its bytes.
bool is_possible(const matvar_t& v, std::size_t file_size) {
  constexpr double most_compressed = 2000.0;
  double bytes = static_cast<double>(std::max(1, v.data_size));
  for (int i = 0; i < v.rank; ++i) bytes *= static_cast<double>(v.dims[i]);
  return bytes <= most_compressed * static_cast<double>(file_size);
}

/// Gives channels the texts of a variable, those of times left out where they have none.
void name_channels(RawRecord& raw, const char* variable, const std::vector<std::string>& texts,
                   std::string RawChannel::*member) {
  if (texts.empty()) return;
  std::vector<RawChannel*> named;
  for (RawChannel& c : raw.channels) named.push_back(&c);
  if (texts.size() != named.size()) {
    std::erase_if(named, [](const RawChannel* c) { return names_time(c->name); });
  }
  if (texts.size() != named.size()) {
    throw ModelError(
        {raw.file}, variable,
        fmt::format("has {} texts, expected one for each of {}", texts.size(), named.size()));
  }
  for (std::size_t i = 0; i < named.size(); ++i) named[i]->*member = texts[i];
}

/// A record, variable after variable.
class MatlabRecord {
 public:
  explicit MatlabRecord(const std::string& file) { raw_.file = file; }

  /// Takes a variable, or a field of a struct: it has the name of the field, as a channel has in
  /// the rig.
  /// @param path  with the names of the structs that it is in
  void take(const matvar_t& v, const std::string& name, const std::string& path) {
    if (v.class_type == MAT_C_STRUCT && v.data && v.rank == 2 && elements_of(v) == 1) {
      take_fields(v, path);
      return;
    }
    const std::vector<double> numbers = numbers_of(v);
    if (numbers.size() == 1 && names_rate(name)) {
      raw_.rate = numbers.front();
    } else if (numbers.size() == 1 && name == "start") {
      raw_.start = numbers.front();
    } else if (numbers.size() > 1) {
      const bool is_taken = std::any_of(raw_.channels.begin(), raw_.channels.end(),
                                        [&](const RawChannel& c) { return c.name == name; });
      add_channels(raw_, v, is_taken ? path : name, numbers);
    } else if (name == "channels" || name == "units") {
      if (v.class_type != MAT_C_CHAR && v.class_type != MAT_C_CELL) {
        throw ModelError({raw_.file}, path, "expected rows of text, or cells of them");
      }
      (name == "units" ? units_ : names_) = texts_of(v);
    } else {
      others_ += (others_.empty() ? "" : ", ") + path;
    }
  }

  RawRecord finished() {
    if (raw_.channels.empty()) {
      throw ModelError(
          {raw_.file}, "",
          fmt::format("has no vector or matrix of real numbers, and a damaged file has "
                      "none either; it has {}",
                      others_.empty() ? "nothing" : others_));
    }
    name_channels(raw_, "units", units_, &RawChannel::unit);
    name_channels(raw_, "channels", names_, &RawChannel::name);
    return std::move(raw_);
  }

 private:
  void take_fields(const matvar_t& v, const std::string& path) {
    auto* of =
        const_cast<matvar_t*>(&v);  // matio asks for one that may change, and changes nothing
    const unsigned count = Mat_VarGetNumberOfFields(of);
    const char* const* names = Mat_VarGetStructFieldnames(of);
    for (unsigned i = 0; names && i < count; ++i) {
      const matvar_t* field = Mat_VarGetStructFieldByIndex(of, i, 0);
      if (field) take(*field, names[i], path + "." + names[i]);
    }
  }

  RawRecord raw_;
  std::vector<std::string> names_, units_;
  std::string others_;
};

/// In the child.
/// @param place         where the file is opened
/// @param name_of_file  for messages
RawRecord matlab_record(const std::string& place, const std::string& name_of_file) {
  const std::string bytes = record_bytes(place);
  require_whole_variables(bytes, name_of_file);
  const MatlabFile file(Mat_Open(place.c_str(), MAT_ACC_RDONLY), &Mat_Close);
  open_nothing_more();
  if (!file) throw ModelError({name_of_file}, "", "is no MATLAB file, or a damaged one");
  MatlabRecord record(name_of_file);
  while (true) {
    const MatlabVariable v(Mat_VarReadNextInfo(file.get()), &Mat_VarFree);
    if (!v) break;
    const std::string name = v->name ? v->name : "";
    if (!is_possible(*v, bytes.size())) {
      throw ModelError({name_of_file}, name, "is larger than the file can hold: it is damaged");
    }
    if (v->rank == 2 && Mat_VarReadDataAll(file.get(), v.get()) != 0) {
      throw ModelError({name_of_file}, name, "cannot be read: the file is damaged");
    }
    record.take(*v, name, name);
  }
  return record.finished();
}

}  // namespace

RawRecord read_matlab_record(const std::filesystem::path& path) {
  const OpenedFile file(path);
  // matio 1.5 ends the process on some damaged files
  const ConfinedChild child(file, path.string(), "MATLAB",
                            [name = path.string(), place = file.place()](const std::string&) {
                              return ConfinedChild::Letter{packed(matlab_record(place, name))};
                            });
  RawRecord raw;
  unpack(child.ask("").bytes, raw);
  return raw;
}

void write_matlab_record(const std::filesystem::path& path, const MeasuredRecord& record,
                         Replaces replaces) {
  std::vector<std::string> names, units;
  for (const MeasuredChannel& c : record.channels) {
    names.push_back(c.name);
    units.push_back(c.unit);
  }
  std::vector<MatlabVariable> variables;
  const Mat& samples = record.samples;
  variables.push_back(matlab_numbers("fs", {record.rate}, 1, 1));
  variables.push_back(matlab_numbers("start", {record.start}, 1, 1));
  variables.push_back(matlab_texts("channels", names));
  variables.push_back(matlab_texts("units", units));
  variables.push_back(matlab_numbers("data", {samples.data(), samples.data() + samples.size()},
                                     static_cast<std::size_t>(samples.rows()),
                                     static_cast<std::size_t>(samples.cols())));
  write_matlab_file(path, matlab_record_head, variables, replaces);
}

}  // namespace whirl::inline io
