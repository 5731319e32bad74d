#pragma once
/// Decompression of what zlib compressed, here because zlib is at home here.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace whirl::inline io::hdf5 {

/// The first bytes, at most so many, of what was compressed; none: it was not, or was damaged
/// before.
std::optional<std::string> inflated(std::string_view compressed, std::size_t most);

}  // namespace whirl::inline io::hdf5
