#pragma once
/// Records of measurements as files, whose format their ending says.

#include <filesystem>
#include <optional>

#include "libdata/measured/measured_record.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// Reads a record.
///
///   .csv .txt .tsv .dat .asc   tables; lines of a header before them, names and units of channels
///   .wav                       16 to 32 bits, float or double: shares of full scale
///   .mat                       MATLAB, vectors or a matrix with a channel per column
///   .uff .unv .ufb             universal file, datasets 58 and 58b of responses over time
///   .h5 .hdf5                  datasets of one length, with an attribute `units`
///   .lvm                       LabVIEW measurement, text
///   .tdms                      channels of LabVIEW in groups
///
/// @param rate  samples per second, for files that do not say it [1/s]
/// @throws ModelError  for what is wrong in a file, with its line or record and what was expected
/// @throws FileError   for a file that cannot be read
MeasuredRecord read_record(const std::filesystem::path& path, std::optional<double> rate = {});

/// Writes a record, which read_record reads; in WAV files names and units are a comment. LabVIEW's
/// files are only read.
/// @throws FileError  if the file cannot be written, as WAV with a rate that is no whole number
void write_record(const std::filesystem::path& path, const MeasuredRecord& record,
                  Replaces replaces);

/// Checks that a file has the ending of a format that is written, before there is anything to
/// write.
/// @throws ModelError  if the file has another ending
void require_record_ending(const std::filesystem::path& path);

}  // namespace whirl::inline io
