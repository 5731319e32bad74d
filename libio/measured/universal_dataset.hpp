#pragma once
/// Datasets of universal files: what is common to all that read numbers of a dataset 58 or 58b.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libio/measured/universal_format.hpp"

namespace whirl::inline io::universal {

/// Goes through the lines of a file.
class UniversalText {
 public:
  UniversalText(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool is_at_end() const { return at_ >= text_.size(); }
  Where where() const { return {file_, line_, 1}; }
  /// The next line, without its end.
  std::string_view line();
  /// Bytes as they are; fewer at the end of the file.
  std::string_view bytes(std::size_t count);
  std::size_t left() const { return text_.size() - at_; }
  [[noreturn]] void fail(const std::string& key, const std::string& message) const {
    throw ModelError(where(), key, message);
  }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// Columns of a record, without blanks around them.
std::string columns_of(std::string_view record, std::size_t from, std::size_t size);

bool is_mark(std::string_view line);

/// Skips what is left of a dataset.
void skip_dataset(UniversalText& text);

/// What a file's units are, by a dataset 164.
struct UniversalFactors {
  double length = 1.0;  ///< how many of its lengths are a metre
  double force = 1.0;   ///< how many of its forces are a newton
};

/// Of a dataset 164, whose head has been read; nothing: it does not say.
std::optional<UniversalFactors> factors_in(UniversalText& text);

/// A number as Fortran may write it.
std::optional<double> number_in(std::string cell);

/// One dataset 58: its records, and its values as they stand there.
class UniversalDataset {
 public:
  /// @param head  the line of its number, which has been read
  /// @throws ModelError  for records that are cut off, and numbers of machines of DEC or IBM
  UniversalDataset(UniversalText& text, std::string_view head, long number);

  /// Columns of a record, from 0, without blanks around them.
  std::string columns(std::size_t record, std::size_t from, std::size_t size) const {
    return columns_of(records_[record], from, size);
  }
  /// A whole number; cells that are blank are 0, as in Fortran.
  long whole(std::size_t record, std::size_t from, std::size_t size, const char* what) const {
    return whole(records_[record], from, size, what);
  }
  /// A number in 13 columns.
  double real(std::size_t record, std::size_t from, const char* what) const;
  /// Node and direction of its response or reference, such as "12 +x".
  std::string end(std::size_t node_from, std::size_t direction_from) const;

  long type() const { return type_; }
  long count() const { return count_; }
  bool is_even() const { return is_even_; }  ///< numbers of the abscissa do not stand there
  bool is_complex() const;
  /// Numbers for each value: its parts, and before them its abscissa where spacing is uneven.
  std::size_t wide() const { return (is_even_ ? 0u : 1u) + (is_complex() ? 2u : 1u); }

  /// All numbers of its values, wide() for each.
  /// @throws ModelError  for a type that is not known, and values that are not all there
  std::vector<double> numbers();

  [[noreturn]] void fail(const std::string& message) const { text_.fail(key_, message); }
  Where where() const { return text_.where(); }

 private:
  long whole(std::string_view record, std::size_t from, std::size_t size, const char* what) const;
  std::size_t number_size() const;
  void require_size() const;
  std::vector<double> binary_numbers();
  double binary_number(std::string_view bytes) const;
  std::vector<double> text_numbers();
  double text_number(const std::string& cell) const;

  UniversalText& text_;
  std::string key_;
  std::array<std::string_view, 11> records_;
  bool is_binary_ = false, is_little_ = true, is_even_ = true;
  long type_ = 0, count_ = 0, byte_count_ = 0;
};

}  // namespace whirl::inline io::universal
