#pragma once
/// Formats of records, a file each.

#include <filesystem>
#include <string>

#include "libio/measured/raw_record.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

RawRecord read_csv_record(const std::filesystem::path& path);
/// The same of a text.
/// @param file  for messages
RawRecord read_csv_text(const std::string& text, const std::string& file);
/// Whether a text has two lines of numbers one after the other.
bool has_csv_numbers(const std::string& text);
/// A sheet of a workbook (.xlsx), which stands behind the file in the path, as in
/// "rig.xlsx#Run 2!A3:F4000", or is the only one that has lines of numbers.
RawRecord read_workbook_record(const std::filesystem::path& path);
RawRecord read_lvm_record(const std::filesystem::path& path);
RawRecord read_tdms_record(const std::filesystem::path& path);
RawRecord read_wav_record(const std::filesystem::path& path);
RawRecord read_matlab_record(const std::filesystem::path& path);
/// @source [UniversalFile58]
RawRecord read_universal_record(const std::filesystem::path& path);
RawRecord read_hdf5_record(const std::filesystem::path& path);

void write_csv_record(const std::filesystem::path& path, const MeasuredRecord& record,
                      Replaces replaces);
void write_wav_record(const std::filesystem::path& path, const MeasuredRecord& record,
                      Replaces replaces);
void write_matlab_record(const std::filesystem::path& path, const MeasuredRecord& record,
                         Replaces replaces);
void write_universal_record(const std::filesystem::path& path, const MeasuredRecord& record,
                            Replaces replaces);
/// With datasets 58b.
void write_binary_universal_record(const std::filesystem::path& path, const MeasuredRecord& record,
                                   Replaces replaces);
void write_hdf5_record(const std::filesystem::path& path, const MeasuredRecord& record,
                       Replaces replaces);

/// All bytes of a file.
/// @throws FileError  for a directory, or a file that cannot be read
std::string record_bytes(const std::filesystem::path& path);

}  // namespace whirl::inline io
