#include "libio/results/row_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

#include "libbase/structs/digest.hpp"
#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "whirlrow";
constexpr std::uint32_t format_number = 1;
constexpr std::size_t at_once = 1u << 18;        ///< bytes read at a time
constexpr std::uint32_t largest_row = 1u << 30;  ///< bytes; more are no row

/// What a journal begins with.
struct Head {
  std::array<char, 8> magic{};
  std::uint32_t format = 0, checksum = 0;
  std::uint64_t key = 0;
};
/// What a row begins with.
struct RowHead {
  std::uint64_t number = 0;
  std::uint32_t size = 0, checksum = 0;  ///< of the number, the size and the bytes
};
static_assert(sizeof(Head) == 24 && sizeof(RowHead) == 16);

[[noreturn]] void fail_to(const fs::path& place, const char* action) {
  throw FileError(fmt::format("cannot {} {}: {}", action, place.string(), std::strerror(errno)));
}

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

Head head_of(std::string_view key) {
  Head head{.format = format_number, .key = digest_of(key)};
  std::copy(magic.begin(), magic.end(), head.magic.begin());
  head.checksum = hdf5::crc32_of(bytes_of(head.key));
  return head;
}

std::uint32_t checksum_of(RowHead head, std::string_view bytes) {
  head.checksum = 0;
  return hdf5::crc32_of(bytes, hdf5::crc32_of(bytes_of(head)));
}

/// Reads bytes of a file one after the other.
class Stream {
 public:
  Stream(int file, const fs::path& place, std::uint64_t at) : file_(file), place_(place), at_(at) {}

  /// The next bytes, valid until the next call; nothing where the file ends before.
  std::optional<std::string_view> take(std::size_t count) {
    if (buffer_.size() - used_ < count) refill(count);
    if (buffer_.size() - used_ < count) return std::nullopt;
    used_ += count;
    return std::string_view(buffer_).substr(used_ - count, count);
  }

 private:
  void refill(std::size_t count) {
    buffer_.erase(0, used_);
    used_ = 0;
    std::size_t have = buffer_.size();
    buffer_.resize(std::max(count, at_once));
    while (have < buffer_.size()) {
      const ssize_t got =
          ::pread(file_, buffer_.data() + have, buffer_.size() - have, static_cast<off_t>(at_));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail_to(place_, "read");
      if (got == 0) break;
      have += static_cast<std::size_t>(got);
      at_ += static_cast<std::uint64_t>(got);
    }
    buffer_.resize(have);
  }

  int file_;
  const fs::path& place_;
  std::uint64_t at_;
  std::string buffer_{};
  std::size_t used_ = 0;
};

/// Calls f with each whole row.
/// @return  where they end
template <class F>
std::uint64_t for_each_row(int file, const fs::path& place, const F& f) {
  std::uint64_t end = sizeof(Head);
  Stream stream(file, place, end);
  while (const auto begin = stream.take(sizeof(RowHead))) {
    RowHead head;
    std::memcpy(&head, begin->data(), sizeof head);
    if (head.size > largest_row) break;
    const auto bytes = stream.take(head.size);
    if (!bytes || checksum_of(head, *bytes) != head.checksum) break;
    f(head.number, *bytes);
    end += sizeof head + head.size;
  }
  return end;
}

void write_at(int file, const fs::path& place, std::string_view bytes, std::uint64_t at) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_to(place, "write");
    bytes.remove_prefix(static_cast<std::size_t>(done));
    at += static_cast<std::uint64_t>(done);
  }
}

void cut(int file, const fs::path& place, std::uint64_t size) {
  if (::ftruncate(file, static_cast<off_t>(size)) != 0) fail_to(place, "write");
}

/// What an open file begins with; nothing if it is shorter.
std::optional<Head> head_in(int file) {
  Head head;
  if (::pread(file, &head, sizeof head, 0) != static_cast<ssize_t>(sizeof head))
    return std::nullopt;
  return head;
}

/// Whether an open file begins as journals do, as far as it goes: a killed process may leave less
/// than that.
bool is_ours(int file) {
  std::array<char, magic.size()> begin{};
  const ssize_t got = ::pread(file, begin.data(), begin.size(), 0);
  return got >= 0 && magic.starts_with({begin.data(), static_cast<std::size_t>(got)});
}

/// Opens a journal that nobody else has open.
/// @return  a descriptor
int open_alone(const fs::path& place) {
  const int file = ::open(place.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) fail_to(place, "write");
  const auto refuse = [&](std::string_view why) {
    ::close(file);
    return fmt::format("cannot write {}: {}", place.string(), why);
  };
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw FileError(refuse("another run is writing it"));
  }  // file systems without locks do without
  if (!is_ours(file))
    throw TakenPlace(refuse("this file is no journal of whirl and would be lost"));
  return file;
}

/// Refuses to drop rows of a study that is another one than is asked for.
void require_no_rows(int file, const fs::path& place) {
  std::size_t rows = 0;
  for_each_row(file, place, [&](std::uint64_t, std::string_view) { ++rows; });
  if (rows == 0) return;
  throw FileError(
      fmt::format("cannot write {}: it has {} rows of another study, or of another model or "
                  "version; take another name, or --restart to drop them",
                  place.string(), rows));
}

}  // namespace

RowJournal::RowJournal(const fs::path& place, std::string_view key, const ReadRow& f)
    : place_(place) {
  if (const std::string problem = problem_of_writing(place); !problem.empty()) {
    throw FileError(fmt::format("cannot write {}: {}", place.string(), problem));
  }
  file_ = open_alone(place);
  try {
    const Head wanted = head_of(key);
    const std::optional<Head> found = head_in(file_);
    if (found && bytes_of(*found) == bytes_of(wanted)) {
      end_ = for_each_row(file_, place_, [&](std::uint64_t number, std::string_view bytes) {
        if (f) f(number, bytes);
      });
      cut(file_, place_, end_);
    } else {
      if (found) require_no_rows(file_, place_);
      cut(file_, place_, 0);
      write_at(file_, place_, bytes_of(wanted), 0);
      end_ = sizeof wanted;
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

RowJournal::~RowJournal() {
  if (file_ >= 0) ::close(file_);
}

void RowJournal::read(const ReadRow& f) const {
  for_each_row(file_, place_, f);
}

void RowJournal::append(std::span<const Row> rows) {
  std::string bytes;
  for (const Row& row : rows) {
    RowHead head{row.number, static_cast<std::uint32_t>(row.bytes.size()), 0};
    head.checksum = checksum_of(head, row.bytes);
    bytes.append(bytes_of(head)).append(row.bytes);
  }
  try {
    write_at(file_, place_, bytes, end_);
    if (::fdatasync(file_) != 0) fail_to(place_, "write");
  } catch (const FileError&) {
    // where this fails, too, what is torn is dropped when the journal is opened again
    [[maybe_unused]] const int code = ::ftruncate(file_, static_cast<off_t>(end_));
    throw;
  }
  end_ += bytes.size();
}

bool RowJournal::is_empty() const {
  return end_ == sizeof(Head);
}

void RowJournal::clear() {
  cut(file_, place_, sizeof(Head));
  end_ = sizeof(Head);
}

void RowJournal::remove() {
  std::error_code ignored;
  fs::remove(place_, ignored);
  ::close(file_);
  file_ = -1;
}

void drop_rows(const fs::path& place) {
  if (!fs::exists(place)) return;
  const int file = open_alone(place);
  const int code = ::ftruncate(file, 0) == 0 ? 0 : errno;
  ::close(file);
  errno = code;
  if (code != 0) fail_to(place, "write");
}

fs::path journal_of(const fs::path& file) {
  fs::path place = file;
  return place += ".rows";
}

std::vector<std::uint64_t> rows_in_journal(const fs::path& place) {
  const int file = ::open(place.c_str(), O_RDONLY | O_CLOEXEC);
  std::vector<std::uint64_t> numbers;
  if (file < 0) return numbers;
  if (is_ours(file)) {
    try {
      for_each_row(file, place,
                   [&](std::uint64_t number, std::string_view) { numbers.push_back(number); });
    } catch (const FileError&) {  // as far as it can be read
    }
  }
  ::close(file);
  return numbers;
}

}  // namespace whirl::inline io
