/// MATLAB files: vectors, or a matrix with a channel per column, also in structs and cells.

#include <fmt/format.h>

#include <algorithm>

#include "libbase/structs/travel.hpp"
#include "libio/measured/matlab_channels.hpp"
#include "libio/measured/matlab_elements.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/results/confined_child.hpp"
#include "libio/results/matlab_variables.hpp"

namespace whirl::inline io {

namespace {

constexpr const char* matlab_record_head = "MATLAB 5.0 MAT-file, measurement, written by whirl";

/// Whether a file can hold a variable: compressed a number takes some thousandths of its bytes.
bool is_possible(const matvar_t& v, std::size_t file_size) {
  constexpr double most_compressed = 2000.0;
  double bytes = static_cast<double>(std::max(1, v.data_size));
  for (int i = 0; i < v.rank; ++i) bytes *= static_cast<double>(v.dims[i]);
  return bytes <= most_compressed * static_cast<double>(file_size);
}

/// In the child.
/// @param place         where the file is opened
/// @param name_of_file  for messages
RawRecord matlab_record(const std::string& place, const std::string& name_of_file) {
  const std::string bytes = record_bytes(place);
  require_whole_variables(bytes, name_of_file);
  const MatlabFile file(Mat_Open(place.c_str(), MAT_ACC_RDONLY), &Mat_Close);
  open_nothing_more();
  if (!file) throw ModelError({name_of_file}, "", "is no MATLAB file, or a damaged one");
  MatlabChannels record(name_of_file);
  while (true) {
    const MatlabVariable v(Mat_VarReadNextInfo(file.get()), &Mat_VarFree);
    if (!v) break;
    const std::string name = v->name ? v->name : "";
    // what objects of MATLAB are made of
    if (name.empty() || name.starts_with('#')) continue;
    if (!is_possible(*v, bytes.size())) {
      throw ModelError({name_of_file}, name, "is larger than the file can hold: it is damaged");
    }
    const bool is_object = v->class_type == MAT_C_OPAQUE || v->class_type == MAT_C_OBJECT;
    if (v->rank == 2 && !is_object && Mat_VarReadDataAll(file.get(), v.get()) != 0) {
      throw ModelError({name_of_file}, name, "cannot be read: the file is damaged");
    }
    record.take(*v, name);
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
