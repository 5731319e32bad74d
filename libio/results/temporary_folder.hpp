#pragma once

#include <filesystem>
#include <string>

#include "libio/text/passing_file.hpp"

namespace whirl::inline io {

/// A folder that is removed at the end: among the system's temporary ones, or beside a file where
/// there are none.
class TemporaryFolder {
 public:
  /// @param what    for its name: "animate"
  /// @param beside  a file
  /// @throws FileError  if no folder can be made
  TemporaryFolder(const std::string& what, const std::filesystem::path& beside);

  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  PassingFile folder_{};
};

}  // namespace whirl::inline io
