#pragma once
/// The files that a call of the program reads and writes, so that none of them is lost to it: a
/// file that is read is not written, and no file is written by two.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// The path that a symbolic link leads to, and further links behind it, whether or not a file is
/// there.
/// @return  the path itself if it is no link; empty if the links lead in a circle
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Whether two names are those of one file, whether or not the file is there.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The list of a call's files. Every reader and every writer of files asks the list of its thread;
/// without a list everything may be read and written.
class FilesInUse {
 public:
  /// Begins a list; within a call that has a list, that list goes on.
  FilesInUse();
  ~FilesInUse();
  FilesInUse(const FilesInUse&) = delete;
  FilesInUse& operator=(const FilesInUse&) = delete;

 private:
  struct Use {
    std::filesystem::path place;
    std::string by;  ///< an output's option; of a file that is read, "--from reads it"
    bool is_last = false;
  };
  friend std::string problem_of_reading(const std::filesystem::path&, std::string_view);
  friend std::string problem_of_output(const std::filesystem::path&, const std::string&, bool);
  friend std::string problem_of_writing(const std::filesystem::path&);
  friend void begin_last_output(const std::filesystem::path&);

  /// The entry of a file that is read; null: the file is not read.
  const Use* reading(const std::filesystem::path& place) const;

  bool is_first_ = false;  ///< whether this object has begun the list
  std::vector<Use> read_{}, outputs_{};
};

/// While an object of this class lives, a file that this thread reads is one that an output
/// replaces or goes on from: reading it does not keep it from being replaced.
class LooksAtOutput {
 public:
  LooksAtOutput();
  ~LooksAtOutput();
  LooksAtOutput(const LooksAtOutput&) = delete;
  LooksAtOutput& operator=(const LooksAtOutput&) = delete;
};

/// Takes down that a file is read.
/// @param by  what reads it: "--from reads it"
/// @return    what is wrong with that: "--json would replace it"; empty: nothing
std::string problem_of_reading(const std::filesystem::path& file,
                               std::string_view by = "this command reads it");

/// Takes down the place of an output before its time, so that nothing else is written there.
/// @param option   that names it: "--out"
/// @param is_last  it is written when all else is
/// @return         what is wrong with that: "--from reads it", "--out and --json name the same
///                 file"
std::string problem_of_output(const std::filesystem::path& place, const std::string& option,
                              bool is_last = false);

/// What is wrong with writing a file now; empty: nothing.
std::string problem_of_writing(const std::filesystem::path& place);

/// From now on the last output may be written.
void begin_last_output(const std::filesystem::path& place);

}  // namespace whirl::inline io
