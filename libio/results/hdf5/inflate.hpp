#pragma once
/// Decompression of what zlib compressed; in this folder, as no other folder uses zlib.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace whirl::inline io::hdf5 {

/// The first `most` bytes, or fewer, of what was compressed; nothing: it was not compressed, or is
/// damaged within these bytes.
std::optional<std::string> inflated(std::string_view compressed, std::size_t most);

}  // namespace whirl::inline io::hdf5
