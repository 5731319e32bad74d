#include "libio/text/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace {

/// A descriptor that is closed.
struct Descriptor {
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  int number;
};

/// Makes room for some more bytes behind so many, less and less often.
void make_room(std::string& text, std::size_t size, std::size_t most) {
  constexpr std::size_t least = 1u << 16u;
  if (text.size() > size) return;
  text.resize(std::min(most, std::max(least, 2 * size)) + 1);  // one more tells of too many
}

}  // namespace

Parsed<std::string> file_bytes(const std::filesystem::path& file, FileKind kind, std::size_t most) {
  using Result = Parsed<std::string>;
  const auto because = [](int code) {
    return Result::failed(std::string("cannot read the file: ") + std::strerror(code));
  };
  // opening a pipe waits for who writes into it
  const int waits = kind == FileKind::regular ? O_NONBLOCK : 0;
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | waits)};
  if (in.number < 0) return because(errno);
  struct stat is {};
  if (::fstat(in.number, &is) != 0) return because(errno);
  if (S_ISDIR(is.st_mode)) return Result::failed("this is a directory, expected a file");
  const bool is_regular = S_ISREG(is.st_mode);
  if (kind == FileKind::regular && !is_regular) {
    return Result::failed("this is a device or a pipe, expected a file");
  }
  const std::string lost = is_regular ? problem_of_reading(file) : "";
  if (!lost.empty()) return Result::failed(lost);
  const auto too_large = [most] {
    return Result::failed(fmt::format("this is larger than {} MB", most >> 20u));
  };
  if (is_regular && static_cast<std::size_t>(is.st_size) > most) return too_large();
  std::string text;
  std::size_t size = 0;
  if (is_regular) text.resize(static_cast<std::size_t>(is.st_size) + 1);
  while (true) {
    make_room(text, size, most);
    const ssize_t got = ::read(in.number, text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return because(errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size > most) return too_large();
  }
  text.resize(size);
  return text;
}

}  // namespace whirl::inline io
