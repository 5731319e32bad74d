#include "libio/measured/matlab_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "libbase/error.hpp"
#include "libio/results/hdf5/inflate.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t tag_bytes = 8;
constexpr int most_cells_deep = 32;

/// Types of elements.
enum ElementType : std::uint32_t { matrix = 14, compressed = 15 };
/// Classes of matrices.
enum MatrixClass : std::uint32_t { cell = 1, structure = 2, object = 3, text = 4, sparse = 5 };
constexpr std::uint32_t first_number = 6, last_number = 15;
constexpr std::uint32_t is_complex_flag = 0x800;

/// Bytes of a value of each type of elements; 0: it has no values.
constexpr std::array<std::size_t, 19> value_bytes{0, 1, 1, 2, 2, 4, 4, 4, 0, 8,
                                                  0, 0, 8, 8, 0, 0, 1, 2, 4};

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

/// Goes through the elements of a file.
class ElementWalk {
 public:
  ElementWalk(const std::string& file, bool is_swapped) : file_(file), is_swapped_(is_swapped) {}

  /// Every variable of a file.
  void check_file(std::string_view bytes, std::size_t at) const {
    while (at < bytes.size()) {
      const bool has_tag = at + tag_bytes <= bytes.size();
      const std::size_t size = has_tag ? tag_bytes + number_at(bytes, at + 4) : tag_bytes;
      if (at + size > bytes.size()) {
        fail("", fmt::format("is cut off: it ends after {} bytes, and a variable that begins at "
                             "byte {} has {}",
                             bytes.size(), at, has_tag ? fmt::format("{}", size) : "more"));
      }
      const std::string_view data = bytes.substr(at + tag_bytes, size - tag_bytes);
      const std::uint32_t type = number_at(bytes, at);
      if (type == ElementType::matrix) check_matrix(data, "", 0);
      if (type == ElementType::compressed) check_compressed(data);
      at += size;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& variable, const std::string& why) const {
    throw ModelError({file_}, variable, why);
  }

  std::uint32_t number_at(std::string_view bytes, std::size_t at) const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto byte = static_cast<unsigned char>(bytes[at + (is_swapped_ ? i : 3 - i)]);
      number = number << 8u | byte;
    }
    return number;
  }

  /// Takes the first element off; none: its bytes are not all there.
  std::optional<Element> take(std::string_view& bytes) const {
    constexpr std::uint32_t low = 0xffffu;
    if (bytes.size() < tag_bytes) return std::nullopt;
    const std::uint32_t first = number_at(bytes, 0);
    if (first > low) {  // a small one: type, size and data in 8 bytes
      const Element element{first & low, bytes.substr(4, std::min<std::size_t>(first >> 16u, 4))};
      bytes.remove_prefix(tag_bytes);
      return element;
    }
    const std::size_t size = number_at(bytes, 4);
    if (size > bytes.size() - tag_bytes) return std::nullopt;
    const Element element{first, bytes.substr(tag_bytes, size)};
    const std::size_t padded = tag_bytes + (size + tag_bytes - 1) / tag_bytes * tag_bytes;
    bytes.remove_prefix(std::min(padded, bytes.size()));
    return element;
  }

  Element taken(std::string_view& bytes, const std::string& variable) const {
    const auto element = take(bytes);
    if (!element) fail(variable, "is cut off: the file is damaged");
    return *element;
  }

  void check_compressed(std::string_view data) const {
    auto head = hdf5::inflated(data, tag_bytes);
    if (!head || head->size() < tag_bytes)
      fail("", "is damaged: a variable cannot be decompressed");
    if (number_at(*head, 0) != ElementType::matrix) return;
    const std::size_t size = number_at(*head, 4);
    const auto all = hdf5::inflated(data, size + tag_bytes);
    if (!all || all->size() < size + tag_bytes) {
      fail("", "is damaged: a variable cannot be decompressed, or only in part");
    }
    check_matrix(std::string_view(*all).substr(tag_bytes), "", 0);
  }

  /// @param within  name of what it is a cell or field of; empty: of nothing
  void check_matrix(std::string_view bytes, const std::string& within, int depth) const {
    if (bytes.empty()) return;  // a cell with nothing in it
    if (depth > most_cells_deep) fail(within, "has too many cells within one another");
    const Element flags = taken(bytes, within), sizes = taken(bytes, within),
                  named = taken(bytes, within);
    if (flags.data.size() < 4) fail(within, "is damaged");
    const std::uint32_t said = number_at(flags.data, 0), kind = said & 0xffu;
    const std::string name = within.empty() ? std::string(named.data) : within;
    std::size_t count = 1;
    for (std::size_t at = 0; at + 4 <= sizes.data.size(); at += 4) {
      if (__builtin_mul_overflow(count, std::size_t{number_at(sizes.data, at)}, &count)) {
        fail(name, "says to hold more values than can be counted");
      }
    }
    if (kind == MatrixClass::cell) {
      check_members(bytes, count, name, depth);
    } else if (kind == MatrixClass::structure || kind == MatrixClass::object) {
      check_structure(bytes, count, kind == MatrixClass::object, name, depth);
    } else if (kind == MatrixClass::text || (kind >= first_number && kind <= last_number)) {
      for (int part = 0; part < ((said & is_complex_flag) != 0 ? 2 : 1); ++part) {
        check_values(bytes, count, name);
      }
    }
  }

  void check_values(std::string_view& bytes, std::size_t count, const std::string& name) const {
    if (count == 0) return;
    const auto values = take(bytes);
    const std::size_t size =
        values && values->type < value_bytes.size() ? value_bytes[values->type] : 0;
    const std::size_t there = size > 0 ? values->data.size() / size : 0;
    if (there >= count) return;
    fail(name, fmt::format("says to hold {} values, the file has {} of them: it is damaged", count,
                           there));
  }

  void check_members(std::string_view& bytes, std::size_t count, const std::string& name,
                     int depth) const {
    for (std::size_t i = 0; i < count; ++i) {
      const Element member = taken(bytes, name);
      if (member.type == ElementType::matrix) check_matrix(member.data, name, depth + 1);
    }
  }

  void check_structure(std::string_view& bytes, std::size_t count, bool has_class,
                       const std::string& name, int depth) const {
    if (has_class) taken(bytes, name);
    const Element length = taken(bytes, name), names = taken(bytes, name);
    const std::size_t each = length.data.size() >= 4 ? number_at(length.data, 0) : 0;
    const std::size_t fields = each > 0 ? names.data.size() / each : 0;
    if (__builtin_mul_overflow(count, fields, &count)) fail(name, "is damaged");
    check_members(bytes, count, name, depth);
  }

  const std::string& file_;
  bool is_swapped_;
};

}  // namespace

void require_whole_variables(const std::string& bytes, const std::string& file) {
  constexpr std::size_t head = 128;
  const bool is_level_5 = bytes.size() >= head &&
                          (bytes.compare(126, 2, "IM") == 0 || bytes.compare(126, 2, "MI") == 0);
  if (!is_level_5 || bytes.compare(0, 10, "MATLAB 7.3") == 0) return;
  ElementWalk(file, bytes[126] == 'M').check_file(bytes, head);
}

}  // namespace whirl::inline io
