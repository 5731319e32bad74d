#pragma once

#include <string>
#include <vector>

namespace whirl::inline io {

/// A table for the terminal: texts to the left, numbers to the right, units in the head.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)) {}

  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// Lines of equal columns; a column is set right if all its cells begin with a digit, sign or
  /// dash, are empty or "·".
  std::string text() const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

/// Columns that a UTF-8 text takes in a terminal (all signs that this project writes are one wide).
std::size_t display_width(const std::string& text);

}  // namespace whirl::inline io
