#pragma once
/// Digests by which a text or a file is known again.

#include <filesystem>
#include <string>
#include <string_view>

namespace whirl::inline io {

/// SHA-256 of a text, as `sha256sum` prints it: 64 hexadecimal digits.
std::string sha256_of(std::string_view text);

/// SHA-256 of a file.
/// @throws FileError  if it cannot be read
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace whirl::inline io
