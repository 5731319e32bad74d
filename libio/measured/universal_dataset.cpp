#include "libio/measured/universal_dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "libio/text/delimited.hpp"

namespace whirl::inline io::universal {

std::string_view UniversalText::line() {
  const auto end = std::min(text_.find('\n', at_), text_.size());
  std::string_view found = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  ++line_;
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

std::string_view UniversalText::bytes(std::size_t count) {
  const std::string_view found = text_.substr(at_, count);
  at_ += found.size();
  return found;
}

std::string columns_of(std::string_view record, std::size_t from, std::size_t size) {
  return from < record.size() ? trimmed(record.substr(from, size)) : "";
}

bool is_mark(std::string_view line) {
  return trimmed(line) == "-1" && line.size() <= 80;
}

void skip_dataset(UniversalText& text) {
  while (!text.is_at_end() && !is_mark(text.line())) {
  }
}

std::optional<double> number_in(std::string cell) {
  for (char& c : cell) {
    if (c == 'D' || c == 'd') c = 'E';
  }
  const auto value = parse_as(cell, "");
  if (value) return *value;
  return std::nullopt;
}

std::optional<UniversalFactors> factors_in(UniversalText& text) {
  constexpr std::size_t wide = 25;
  text.line();
  const std::string_view line = text.line();
  const auto length = number_in(columns_of(line, 0, wide));
  if (!length || !(*length > 0.0)) return std::nullopt;
  const auto force = number_in(columns_of(line, wide, wide));
  return UniversalFactors{*length, force && *force > 0.0 ? *force : 1.0};
}

UniversalDataset::UniversalDataset(UniversalText& text, std::string_view head, long number)
    : text_(text), key_(fmt::format("dataset {}", number)) {
  is_binary_ = head.size() > 6 && (head[6] == 'b' || head[6] == 'B');
  if (is_binary_) {
    is_little_ = whole(head, 7, 6, "byte order") == RecordCode::little_endian;
    if (whole(head, 13, 6, "form of numbers") != RecordCode::ieee) {
      fail("its numbers are those of DEC or IBM, expected IEEE 754 (2)");
    }
    byte_count_ = whole(head, 31, 12, "number of bytes");
  }
  for (std::string_view& record : records_) {
    if (text_.is_at_end()) fail("is cut off, expected 11 records before its values");
    record = text_.line();
  }
  type_ = whole(6, 0, 10, "type of values");
  count_ = whole(6, 10, 10, "number of values");
  is_even_ = whole(6, 20, 10, "spacing of values") != 0;
}

long UniversalDataset::whole(std::string_view record, std::size_t from, std::size_t size,
                             const char* what) const {
  const std::string cell = columns_of(record, from, size);
  if (cell.empty()) return 0;
  const auto value = parse_as(cell, "");
  if (!value || *value != std::floor(*value) || std::abs(*value) > 1e12) {
    fail(fmt::format("found {}, expected a whole number: its {}", in_quotes(cell), what));
  }
  return static_cast<long>(*value);
}

double UniversalDataset::real(std::size_t record, std::size_t from, const char* what) const {
  const std::string cell = columns(record, from, 13);
  if (cell.empty()) return 0.0;
  const auto value = number_in(cell);
  if (!value) fail(fmt::format("found {}, expected a number: its {}", in_quotes(cell), what));
  return *value;
}

std::string UniversalDataset::end(std::size_t node_from, std::size_t direction_from) const {
  static constexpr std::array<const char*, 7> directions{"",     " +x",  " +y", " +z",
                                                         " +rx", " +ry", " +rz"};
  const double direction = number_in(columns(5, direction_from, 4)).value_or(0.0);
  std::string way;
  if (std::abs(direction) < static_cast<double>(directions.size())) {
    way = directions[static_cast<std::size_t>(std::abs(direction))];
  }
  if (direction < 0.0 && !way.empty()) way[1] = '-';
  return columns(5, node_from, 10) + way;
}

bool UniversalDataset::is_complex() const {
  return type_ == RecordCode::complex_single || type_ == RecordCode::complex_double;
}

/// Of a number in binary form.
std::size_t UniversalDataset::number_size() const {
  const bool is_double = type_ == RecordCode::real_double || type_ == RecordCode::complex_double;
  return is_double ? 8 : 4;
}

std::vector<double> UniversalDataset::numbers() {
  if (!is_complex() && type_ != RecordCode::real_single && type_ != RecordCode::real_double) {
    fail(fmt::format("has values of type {}, expected 2 (single) or 4 (double)", type_));
  }
  if (count_ < 1) fail(fmt::format("has {} values, expected two or more", count_));
  require_size();
  return is_binary_ ? binary_numbers() : text_numbers();
}

/// Nothing is made room for that the file cannot hold.
void UniversalDataset::require_size() const {
  const auto count = static_cast<std::size_t>(count_);
  constexpr std::size_t least_text = 2;
  const std::size_t abscissa = is_even_ ? 0 : 4, parts = is_complex() ? 2 : 1;
  const std::size_t least = is_binary_ ? abscissa + parts * number_size() : least_text * wide();
  if (count > text_.left() / least) {
    fail(
        fmt::format("is cut off: its {} values do not fit into the {} bytes that are "
                    "left",
                    count, text_.left()));
  }
  if (is_binary_ && (byte_count_ < 0 || static_cast<std::size_t>(byte_count_) < count * least)) {
    fail(fmt::format("says that its {} values take {} bytes", count, byte_count_));
  }
}

std::vector<double> UniversalDataset::binary_numbers() {
  const std::string_view bytes = text_.bytes(static_cast<std::size_t>(byte_count_));
  const std::size_t numbers = static_cast<std::size_t>(count_) * wide();
  // abscissas of values of type double may be single
  const bool has_single_abscissas = !is_even_ && bytes.size() < numbers * number_size();
  std::vector<double> values;
  values.reserve(numbers);
  std::size_t at = 0;
  for (std::size_t i = 0; i < numbers; ++i) {
    const std::size_t size = has_single_abscissas && i % wide() == 0 ? 4 : number_size();
    if (at + size > bytes.size()) fail("is cut off within its values");
    values.push_back(binary_number(bytes.substr(at, size)));
    at += size;
  }
  return values;
}

double UniversalDataset::binary_number(std::string_view bytes) const {
  std::array<char, 8> turned{};
  const bool is_native = is_little_ == (std::endian::native == std::endian::little);
  if (is_native) {
    std::copy(bytes.begin(), bytes.end(), turned.begin());
  } else {
    std::reverse_copy(bytes.begin(), bytes.end(), turned.begin());
  }
  if (bytes.size() == 4) {
    float single = 0.0F;
    std::memcpy(&single, turned.data(), sizeof single);
    return single;
  }
  double value = 0.0;
  std::memcpy(&value, turned.data(), sizeof value);
  return value;
}

/// Values in columns of 13 or 20 characters: 20 for those of type double, not for abscissas.
std::vector<double> UniversalDataset::text_numbers() {
  const std::size_t numbers = static_cast<std::size_t>(count_) * wide();
  std::vector<double> values;
  values.reserve(numbers);
  while (values.size() < numbers) {
    if (text_.is_at_end()) fail("is cut off within its values");
    const std::string_view line = text_.line();
    if (is_mark(line)) {
      fail(fmt::format("ends after {} numbers, expected {}", values.size(), numbers));
    }
    std::size_t at = 0;
    while (at < line.size() && values.size() < numbers) {
      const bool is_abscissa = !is_even_ && values.size() % wide() == 0;
      const std::size_t size = number_size() == 8 && !is_abscissa ? 20 : 13;
      const std::string cell = columns_of(line, at, size);
      at += size;
      if (cell.empty()) break;
      values.push_back(text_number(cell));
    }
  }
  return values;
}

double UniversalDataset::text_number(const std::string& cell) const {
  if (const auto value = number_in(cell)) return *value;
  if (plain_name(cell) == "nan") return std::nan("");
  fail(fmt::format("found {}, expected a number in columns of {}", in_quotes(cell),
                   number_size() == 8 ? 20 : 13));
}

}  // namespace whirl::inline io::universal
