#pragma once
/// A checksum behind the end of a result file: whether it is as whirl wrote it.

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace whirl::inline io::hdf5 {

/// CRC-32 of bytes, or of bytes behind others whose CRC-32 is `before`.
std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before = 0);

/// What the end of a file says about its content.
enum class Seal {
  none,    ///< no checksum: the file is of an older version, or changed by another program
  whole,   ///< the content is the one that was written
  broken,  ///< the content is not the one that was written
};

/// Appends the checksum of a closed HDF5 file to it: a line of text behind what HDF5 calls its end.
///
/// HDF5 does not look there. A program that opens the file to change it cuts the line off, so that
/// only damage breaks the seal.
///
/// @throws FileError  if the file cannot be read or written
void seal(const std::filesystem::path& file);

/// @throws FileError  if the file cannot be read
Seal seal_of(const std::filesystem::path& file);

}  // namespace whirl::inline io::hdf5
