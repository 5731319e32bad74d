#pragma once

#include <filesystem>

#include "libio/text/passing_file.hpp"

namespace whirl::inline io {

/// Keeps other calls from an output as long as it lives, by a locked file beside it,
/// "atlas.h5.lock". A lock ends with its process, however that ends; the file then may stay, and
/// keeps nobody out.
class OutputLock {
 public:
  /// @throws FileError  if another call has it, or the file cannot be made
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  PassingFile beside_{};
  int file_ = -1;
};

}  // namespace whirl::inline io
