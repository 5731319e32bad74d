#include "libio/text/encoding.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <cctype>

namespace whirl::inline io {

namespace {

/// Bytes of the character of UTF-8 that a text begins with; 0: it begins with none.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
  }
  // longer than needed, halves of UTF-16, beyond the last character
  const unsigned char second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  return size;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

/// @return  nothing: the text is not in that encoding
std::optional<std::string> converted(std::string& text, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  // a byte becomes three at most
  std::string found(3 * text.size(), '\0');
  char *from = text.data(), *to = found.data();
  std::size_t left = text.size(), room = found.size();
  const std::size_t result = iconv(converter, &from, &left, &to, &room);
  iconv_close(converter);
  if (result == static_cast<std::size_t>(-1)) return std::nullopt;
  found.resize(found.size() - room);
  return found;
}

/// The form of UTF-16 that a text begins in; null: none.
const char* utf16_of(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16";
  if (text.size() < 2 || (text[0] == '\0') == (text[1] == '\0')) return nullptr;
  return text[1] == '\0' ? "UTF-16LE" : "UTF-16BE";
}

}  // namespace

Parsed<std::string> in_utf8(std::string text) {
  using Result = Parsed<std::string>;
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (const char* form = utf16_of(text)) {
    auto found = converted(text, form);
    if (found) return std::move(*found);
    return Result::failed("begins as UTF-16 and is none: expected text in UTF-8");
  }
  if (is_utf8(text)) return text;
  auto found = converted(text, "WINDOWS-1252");
  if (found) return std::move(*found);
  return Result::failed("is text in none of UTF-8, UTF-16 and Windows-1252: save it in UTF-8");
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace whirl::inline io
