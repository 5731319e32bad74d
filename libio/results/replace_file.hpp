#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string_view>

#include "libio/text/passing_file.hpp"

namespace whirl::inline io {

/// A file cannot be read or written; says which one and why.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A place is taken by a file that would be lost; says which one and why.
class TakenPlace : public FileError {
 public:
  using FileError::FileError;
};

/// What a file may take the place of, beside nothing and an empty file.
enum class Replaces {
  own_results,   ///< results (HDF5) of this program
  own_pictures,  ///< pictures, pages, answers and exports of this program
  anything,
};

/// @throws TakenPlace  if a file is there that may not be replaced
void require_replaceable(const std::filesystem::path& place, Replaces what);

/// Checks a place without writing there.
/// @throws FileError  if there is no such directory, or if the place is taken by something that is
///                    not a file, such as /dev/null, or by a file that may not be replaced
void require_place(const std::filesystem::path& place, Replaces what);

/// A file that is written under another name and takes its place when it is complete; without
/// commit() it is removed at the end.
///
/// Whoever opens the place finds the old file or the new one, whole, at whatever moment this
/// process is killed. The other name is "<name>.tmp.<process number>", of a new file, which SIGKILL
/// alone leaves behind.
class FileReplacement {
 public:
  /// @param place  a file, which need not exist yet, in a directory that does
  /// @throws FileError  as require_place, and if the call of the program reads that file
  explicit FileReplacement(const std::filesystem::path& place,
                           Replaces what = Replaces::own_pictures);
  const std::filesystem::path& place() const { return place_; }
  /// Where to write: a file next to the place.
  const std::filesystem::path& temporary() const { return temporary_.path(); }

  /// Brings the closed temporary file to the disk and moves it to its place.
  /// @throws FileError  the place then is as it was
  void commit();

 private:
  std::filesystem::path place_;
  PassingFile temporary_{};
};

/// What a file may replace: anything if the file at the place begins as those of this program do,
/// else `what`.
/// @param head  how files of this program begin
Replaces replaces_own(const std::filesystem::path& place, std::string_view head, Replaces what);

/// Replaces a file by what f writes.
/// @throws FileError
void replace_file(const std::filesystem::path& place, const std::function<void(std::ostream&)>& f,
                  Replaces what = Replaces::own_pictures);

/// Replaces a file by a text.
/// @throws FileError
void replace_file(const std::filesystem::path& place, std::string_view text,
                  Replaces what = Replaces::own_pictures);

}  // namespace whirl::inline io
