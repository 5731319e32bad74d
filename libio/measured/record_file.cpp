#include "libio/measured/record_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "libio/measured/record_formats.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/file_bytes.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

struct RecordFormat {
  std::string_view endings;  ///< each between blanks
  RawRecord (*read)(const fs::path&);
  void (*write)(const fs::path&, const MeasuredRecord&, Replaces);  ///< nothing: is read only
};

constexpr std::array<RecordFormat, 9> record_formats{{
    {" .csv .txt .tsv .dat .asc ", read_csv_record, write_csv_record},
    {" .wav ", read_wav_record, write_wav_record},
    {" .mat ", read_matlab_record, write_matlab_record},
    {" .uff .unv ", read_universal_record, write_universal_record},
    {" .ufb ", read_universal_record, write_binary_universal_record},
    {" .h5 .hdf5 ", read_hdf5_record, write_hdf5_record},
    {" .lvm ", read_lvm_record, nullptr},
    {" .tdms ", read_tdms_record, nullptr},
    {" .xlsx .xlsm ", read_workbook_record, nullptr},
}};

const RecordFormat& format_of(const fs::path& path) {
  const std::string ending =
      lower_case(fs::path(sheet_name(path.string()).file).extension().string());
  for (const RecordFormat& format : record_formats) {
    if (ending.empty()) break;
    if (format.endings.find(" " + ending + " ") != std::string_view::npos) return format;
  }
  throw ModelError({path.string()}, "",
                   "expected a record of a measurement, whose ending says its format: .csv .txt "
                   ".tsv .dat .asc, .wav, .mat, .uff .unv .ufb, .h5 .hdf5, .lvm, .tdms, .xlsx .xlsm");
}

const RecordFormat& written_format_of(const fs::path& path) {
  const RecordFormat& format = format_of(path);
  if (format.write) return format;
  throw ModelError({path.string()}, "",
                   "records with this ending can be read, but not written; these are written: .csv "
                   ".txt .tsv .dat .asc, .wav, .mat, .uff .unv .ufb, .h5 .hdf5");
}

}  // namespace

std::string record_bytes(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw FileError(path.string() + " is a directory");
  auto bytes = file_bytes(path, FileKind::regular, most_record_bytes);
  if (!bytes) throw FileError(fmt::format("{}: {}", path.string(), bytes.problem));
  return std::move(*bytes.value);
}

MeasuredRecord read_record(const fs::path& path, std::optional<double> rate) {
  return finished(format_of(path).read(path), rate);
}

void write_record(const fs::path& path, const MeasuredRecord& record, Replaces replaces) {
  written_format_of(path).write(path, record, replaces);
}

void require_record_ending(const fs::path& path) {
  written_format_of(path);
}

}  // namespace whirl::inline io
