#pragma once
/// Rows of a long table as bytes: in memory while they are few, on the disk where they are many.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline base {

/// Rows of any size, by their number.
///
/// Bytes are appended, also those of a row that is set again. If a folder is given, the oldest
/// bytes go into a file there as soon as all bytes together exceed what may be in memory. The file
/// has no name, and is gone with the last copy of the store. If the file cannot be written, rows
/// stay in memory.
///
/// Any number of threads may read while none writes; copies of a store that share a file count as
/// one store.
class RowStore {
 public:
  /// Numbers of bytes.
  struct Limits {
    std::size_t block = std::size_t{1} << 20;      ///< that go to the disk together
    std::size_t in_memory = std::size_t{1} << 27;  ///< in all; what is more goes to the disk
  };

  explicit RowStore(std::size_t rows = 0) : RowStore(rows, Limits{}) {}
  RowStore(std::size_t rows, Limits limits) : limits_(limits), places_(rows, none) {}

  /// From now on, what does not fit into memory goes into a file of this folder.
  void overflow_into(std::filesystem::path folder) { folder_ = std::move(folder); }

  std::size_t size() const { return places_.size(); }
  void resize(std::size_t rows) { places_.resize(rows, none); }
  bool has(std::size_t row) const { return places_[row] != none; }
  void set(std::size_t row, std::string_view bytes);

  /// The bytes of a row that is there, valid until `buffer` or the store changes.
  /// @throws NumericalError  if they cannot be read from the disk
  std::string_view get(std::size_t row, std::string& buffer) const;

  /// Bytes of rows that are on the disk.
  std::size_t on_disk() const;

 private:
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  class File;
  /// Rows one behind the other, each with its size in front.
  struct Block {
    std::uint64_t begin = 0;  ///< place of its first byte among all
    std::uint64_t size = 0;
    std::string bytes{};        ///< empty once they are on the disk
    std::uint64_t in_file = 0;  ///< place of the bytes there
  };

  void make_room();

  Limits limits_;
  std::vector<std::uint64_t> places_;
  std::vector<Block> blocks_{};
  std::size_t written_ = 0;  ///< number of blocks, the first ones, that are on the disk
  std::filesystem::path folder_{};
  std::shared_ptr<File> file_{};
};

}  // namespace whirl::inline base
