#pragma once

#include <filesystem>
#include <string>

namespace whirl::inline io {

/// Text of a model file.
/// @throws ModelError  for a directory, or a file that cannot be read
std::string file_text(const std::filesystem::path& path);

}  // namespace whirl::inline io
