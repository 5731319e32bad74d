#pragma once
/// Text within XML and HTML.

#include <string>
#include <string_view>

namespace whirl {

/// Text with the signs of XML replaced, and without those that XML 1.0 has no way to hold.
inline std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
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
        if (static_cast<unsigned char>(c) >= ' ') out += c;
    }
  }
  return out;
}

}  // namespace whirl
