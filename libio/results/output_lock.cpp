#include "libio/results/output_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "libio/results/replace_file.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

/// Whether an open file still has its name: its process may have taken it away meanwhile.
bool is_there(int file, const fs::path& name) {
  struct stat open {
  }, named{};
  return ::fstat(file, &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace

OutputLock::OutputLock(const fs::path& output) {
  const fs::path name = behind_links(output).string() + ".lock";
  const auto fail = [&](std::string_view why) {
    throw FileError(fmt::format("cannot write {}: {}", output.string(), why));
  };
  const SignalsWait waiting;
  while (true) {
    file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (file_ < 0) fail(fmt::format("its lock {}: {}", name.string(), std::strerror(errno)));
    const bool is_alone = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
    const int code = is_alone ? 0 : errno;
    struct stat is {};
    const bool is_empty = ::fstat(file_, &is) == 0 && S_ISREG(is.st_mode) && is.st_size == 0;
    const bool is_named = is_there(file_, name);  // else its process has just taken it away
    if (is_empty && is_named && code != EWOULDBLOCK) break;  // or a file system has no locks
    ::close(file_);
    if (!is_empty) fail(fmt::format("{} is no lock of whirl", name.string()));
    if (is_named) fail("another run is writing it; wait for its end, or take another name");
  }
  beside_.adopt(name);
}

OutputLock::~OutputLock() {
  beside_.remove();  // while it is locked, so that nobody else has it
  ::close(file_);
}

}  // namespace whirl::inline io
