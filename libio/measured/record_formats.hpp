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
