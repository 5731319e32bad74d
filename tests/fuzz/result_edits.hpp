#pragma once
/// Result files with something changed in them, as a stranger could write them.

#include <cstdint>
#include <filesystem>
#include <span>

namespace whirl::fuzz {

/// Writes a sound HDF5 file that holds what a seed of tests/fuzz/results holds, with edits.
///
/// @param input  first byte: which seed; then edits of four bytes each: which entry of the result
///               schema, what is done to it, and two numbers for that
/// @throws FileError  for what HDF5 does not write
void write_edited(std::span<const std::uint8_t> input, const std::filesystem::path& path);

}  // namespace whirl::fuzz
