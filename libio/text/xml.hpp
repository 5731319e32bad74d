#pragma once
/// Text within XML and HTML.

#include <algorithm>
#include <string>
#include <string_view>

namespace whirl::inline io {

/// How many bytes from the start of a text are one character that XML 1.0 and JSON can hold; 0:
/// none.
///
/// Left out are controls, surrogates, U+FFFE, U+FFFF, and what is not UTF-8 [XML 1.0, 2.2].
inline std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= ' ' ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  unsigned code = byte(0) & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr unsigned least[] = {0x80, 0x800, 0x10000};  // the least character of each length
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool is_none = code == 0xfffe || code == 0xffff || code > 0x10ffff;
  return code < least[length - 2] || is_surrogate || is_none ? 0 : length;
}

/// Text with the signs of XML replaced, and without what XML 1.0 has no way to hold.
inline std::string xml_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    switch (text.front()) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return out;
}

}  // namespace whirl::inline io
