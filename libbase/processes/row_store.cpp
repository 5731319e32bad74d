#include "libbase/processes/row_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "libbase/error.hpp"

namespace whirl::inline base {

namespace {

using Size = std::uint64_t;  ///< in front of a row

constexpr std::size_t first_read = 1024;  ///< bytes: most rows are shorter

}  // namespace

/// A file without a name, to which is appended.
class RowStore::File {
 public:
  /// @param folder  where it is; check is_open() afterwards
  explicit File(const std::filesystem::path& folder) {
    std::string name = (folder / ".whirl-rows-XXXXXX").string();
    id_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (id_ >= 0) ::unlink(name.c_str());
  }
  ~File() {
    if (id_ >= 0) ::close(id_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return id_ >= 0; }
  std::uint64_t end() const { return end_; }

  /// @return  false: it cannot be written, and is as it was
  bool append(std::string_view bytes) {
    std::uint64_t at = end_;
    while (!bytes.empty()) {
      const ssize_t done = ::pwrite(id_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(done));
      at += static_cast<std::uint64_t>(done);
    }
    end_ = at;
    return true;
  }

  /// @throws NumericalError  if there are not so many bytes
  void read(std::uint64_t at, char* to, std::size_t count) const {
    while (count > 0) {
      const ssize_t got = ::pread(id_, to, count, static_cast<off_t>(at));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        throw NumericalError(fmt::format("cannot read rows that were put aside on the disk: {}",
                                         got < 0 ? std::strerror(errno) : "they are gone"));
      }
      to += got;
      at += static_cast<std::uint64_t>(got);
      count -= static_cast<std::size_t>(got);
    }
  }

 private:
  int id_ = -1;
  std::uint64_t end_ = 0;
};

void RowStore::set(std::size_t row, std::string_view bytes) {
  const Size size = bytes.size();
  const std::size_t needed = sizeof size + bytes.size();
  const bool is_full =
      blocks_.empty() || written_ == blocks_.size() || blocks_.back().size + needed > limits_.block;
  if (is_full) {
    make_room();
    Block next;
    if (!blocks_.empty()) {  // the first one of a small study grows as it needs
      next.begin = blocks_.back().begin + blocks_.back().size;
      next.bytes.reserve(std::max(limits_.block, needed));
    }
    blocks_.push_back(std::move(next));
  }
  Block& block = blocks_.back();
  places_[row] = block.begin + block.size;
  block.bytes.append(reinterpret_cast<const char*>(&size), sizeof size).append(bytes);
  block.size = block.bytes.size();
}

void RowStore::make_room() {
  while (!folder_.empty() && (blocks_.size() - written_) * limits_.block > limits_.in_memory) {
    if (!file_) file_ = std::make_shared<File>(folder_);
    Block& block = blocks_[written_];
    const std::uint64_t at = file_->end();
    if (!file_->is_open() || !file_->append(block.bytes)) {
      folder_.clear();  // what is on the disk stays there
      return;
    }
    block.in_file = at;
    std::string().swap(block.bytes);  // an assignment would keep its memory
    ++written_;
  }
}

std::string_view RowStore::get(std::size_t row, std::string& buffer) const {
  const std::uint64_t place = places_[row];
  const auto next = std::upper_bound(blocks_.begin(), blocks_.end(), place,
                                     [](std::uint64_t p, const Block& b) { return p < b.begin; });
  const Block& block = *std::prev(next);
  const std::uint64_t offset = place - block.begin;
  Size size = 0;
  if (!block.bytes.empty()) {
    std::memcpy(&size, block.bytes.data() + offset, sizeof size);
    return std::string_view(block.bytes).substr(offset + sizeof size, size);
  }
  const auto read = [&](std::size_t from, std::size_t to) {
    buffer.resize(std::max(buffer.size(), to));
    file_->read(block.in_file + offset + from, buffer.data() + from, to - from);
  };
  const std::size_t begin = std::min<std::size_t>(first_read, block.size - offset);
  read(0, begin);
  std::memcpy(&size, buffer.data(), sizeof size);
  const std::size_t end = sizeof size + size;
  if (end > begin) read(begin, end);
  return std::string_view(buffer).substr(sizeof size, size);
}

std::size_t RowStore::on_disk() const {
  return written_ == 0 ? 0 : blocks_[written_ - 1].begin + blocks_[written_ - 1].size;
}

}  // namespace whirl::inline base
