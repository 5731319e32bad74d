#pragma once
/// Files as texts, none of which can hold the program up or fill the memory.

#include <cstddef>
#include <filesystem>
#include <string>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// What a name may stand for.
enum class FileKind {
  regular,  ///< a file on the disk: for names that stand in files
  stream,   ///< also a pipe or a device: for names that somebody gave on the command line
};

/// The most bytes of a model, a table, a list of records or a model of another program; and those
/// of a record of a measurement.
constexpr std::size_t most_text_bytes = std::size_t{1} << 28u;
constexpr std::size_t most_record_bytes = std::size_t{1} << 32u;

/// All bytes of a file.
/// @param most  bytes, beyond which nothing is read
/// @return      these, or what is wrong: "cannot read the file: No such file or directory"
Parsed<std::string> file_bytes(const std::filesystem::path& file, FileKind kind, std::size_t most);

}  // namespace whirl::inline io
