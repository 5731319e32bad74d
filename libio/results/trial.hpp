#pragma once

#include <filesystem>
#include <functional>

namespace whirl::inline io {

/// Reads a file in a child process first, where the library that reads it ends the process on damaged
/// files, or never returns from some.
///
/// @param format  of the file, for messages
/// @param read    reads all of it; what it throws is left to the parent, who meets and names it
/// @throws FileError  if the child was ended by a signal or ran too long
void try_in_child(const std::filesystem::path& file, const char* format,
                  const std::function<void()>& read);

}  // namespace whirl::inline io
