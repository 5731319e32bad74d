#include "libio/results/replace_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "libio/results/own_file.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& place, std::string_view reason) {
  throw FileError(fmt::format("cannot write {}: {}", place.string(), reason));
}

/// Has the system write its buffers of a file or directory to the disk.
/// @return 0 or the number of the error
int synchronize(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int code = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  return code;
}

}  // namespace

void require_replaceable(const fs::path& place, Replaces what) {
  if (what == Replaces::anything) return;
  const Origin origin = origin_of(place);
  if (origin == Origin::nowhere) return;
  if (origin == (what == Replaces::own_results ? Origin::result : Origin::picture)) return;
  const std::string_view is = what == Replaces::own_results ? "is no result of whirl"
                              : origin == Origin::result    ? "is a result of whirl"
                                                            : "was not written by whirl";
  throw TakenPlace(
      fmt::format("cannot write {}: this file {} and would be lost", place.string(), is));
}

void require_place(const fs::path& place, Replaces what) {
  std::error_code ignored;
  const fs::path file = behind_links(place);
  const fs::path directory = file.has_parent_path() ? file.parent_path() : ".";
  if (!file.has_filename()) {
    fail(place,
         place.has_filename() ? "its links lead in a circle" : "this is not the name of a file");
  }
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
    fail(place, fs::is_directory(file, ignored) ? "it is a directory" : "it is not a file");
  }
  if (!fs::is_directory(directory, ignored)) {
    fail(place, fmt::format("there is no directory {}", directory.string()));
  }
  require_replaceable(file, what);
}

// what is behind a link is replaced, not the link
FileReplacement::FileReplacement(const fs::path& place, Replaces what)
    : place_(behind_links(place)) {
  const std::string problem = problem_of_writing(place);
  if (!problem.empty()) fail(place, problem);
  require_place(place, what);
  // a second one of this process, or what another process of this number has left, has the first
  // name
  constexpr int most = 100;
  const std::string name = fmt::format("{}.tmp.{}", place_.string(), ::getpid());
  int code = temporary_.make(name);
  for (int i = 1; code == EEXIST && i < most; ++i) {
    code = temporary_.make(fmt::format("{}.{}", name, i));
  }
  if (code != 0) fail(place, std::strerror(code));
}

void FileReplacement::commit() {
  if (const int code = synchronize(temporary())) fail(place_, std::strerror(code));
  std::error_code problem;
  fs::rename(temporary(), place_, problem);
  if (problem) fail(place_, problem.message());
  temporary_.forget();
  // the new name must reach the disk too; some file systems cannot do that, and then need not
  synchronize(place_.has_parent_path() ? place_.parent_path() : ".");
}

Replaces replaces_own(const fs::path& place, std::string_view head, Replaces what) {
  std::string begin(head.size(), '\0');
  std::ifstream(place, std::ios::binary).read(begin.data(), std::ssize(begin));
  return begin == head ? Replaces::anything : what;
}

void replace_file(const fs::path& place, const std::function<void(std::ostream&)>& f,
                  Replaces what) {
  FileReplacement file(place, what);
  std::ofstream stream(file.temporary(), std::ios::binary);
  errno = 0;
  f(stream);
  stream.close();
  if (!stream) fail(place, errno != 0 ? std::strerror(errno) : "the disk is full or fails");
  file.commit();
}

void replace_file(const fs::path& place, std::string_view text, Replaces what) {
  replace_file(
      place, [&](std::ostream& out) { out << text; }, what);
}

}  // namespace whirl::inline io
