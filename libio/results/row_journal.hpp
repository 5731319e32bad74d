#pragma once
/// Rows of a large study beside its result file: a saving costs no more than the rows that are new.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// Numbered rows of bytes, appended and never changed, each with its checksum.
///
/// Killed at any moment, the process leaves all rows of earlier appends; of the last append those
/// rows that reached the disk. A row that is not whole, and all behind it, is dropped when the
/// journal is opened to go on. A process that has the journal open keeps others out.
///
///     "whirlrow" format crc32 key    then for each row:    number size crc32 bytes
///
/// Numbers are those of the machine: of 64 bits for a row's number and the key, else of 32 bits.
class RowJournal {
 public:
  struct Row {
    std::uint64_t number = 0;
    std::string bytes{};
  };

  using ReadRow = std::function<void(std::uint64_t number, std::string_view bytes)>;

  /// Opens the journal at a place, or begins one.
  ///
  /// @param key  which study the rows are of
  /// @param f    called with each row that is there; may be empty
  /// @throws FileError   if the file cannot be read or written, if another process has it open, or
  ///                     if it has rows of another study
  /// @throws TakenPlace  if there is a file that is no journal
  RowJournal(const std::filesystem::path& place, std::string_view key, const ReadRow& f = {});
  ~RowJournal();
  RowJournal(const RowJournal&) = delete;
  RowJournal& operator=(const RowJournal&) = delete;

  const std::filesystem::path& place() const { return place_; }

  /// Calls f with each row, in the order in which they were appended.
  /// @throws FileError
  void read(const ReadRow& f) const;

  /// Appends rows and brings them to the disk.
  /// @throws FileError  the journal then is as it was
  void append(std::span<const Row> rows);

  bool is_empty() const;

  /// Drops all rows.
  /// @throws FileError
  void clear();

  /// Removes the file; no other function may be called afterwards.
  void remove();

 private:
  std::filesystem::path place_;
  int file_ = -1;
  std::uint64_t end_ = 0;  ///< of the rows that are whole
};

/// Drops all rows of a journal, of whatever study they are.
/// @throws FileError, TakenPlace  as RowJournal
void drop_rows(const std::filesystem::path& place);

/// Where the journal of a result file is: beside it, "atlas.h5.rows".
std::filesystem::path journal_of(const std::filesystem::path& file);

/// Numbers of the rows of a journal, which another process may be writing; none if there is no
/// journal.
std::vector<std::uint64_t> rows_in_journal(const std::filesystem::path& place);

}  // namespace whirl::inline io
