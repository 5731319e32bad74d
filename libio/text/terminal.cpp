#include "libio/text/terminal.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "libio/text/table.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t fewest_columns = 40;  ///< columns; a table of less says nothing

}  // namespace

std::size_t terminal_columns() {
  if (const char* text = std::getenv("COLUMNS")) {
    const std::string_view digits(text);
    std::size_t columns = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), columns);
    if (error == std::errc() && end == digits.data() + digits.size() && columns > 0) {
      return std::max(fewest_columns, columns);
    }
  }
  winsize size{};
  const bool is_known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? std::max<std::size_t>(fewest_columns, size.ws_col) : 0;
}

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;  // not a continuation byte
  }));
}

std::vector<std::string> folded_words(const std::string& line, std::size_t columns) {
  if (display_width(line) <= columns) return {line};
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < line.size();) {
    const std::size_t to = std::min(line.find(' ', from), line.size());
    const std::string word = line.substr(from, to - from);
    if (lines.back().empty()) {
      lines.back() = word;
    } else if (display_width(lines.back()) + 1 + display_width(word) <= columns) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
    from = to + 1;
  }
  return lines;
}

std::string folded(const std::string& text, std::size_t columns) {
  if (columns == 0) return text;
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    const std::string line = text.substr(from, end == std::string::npos ? end : end - from);
    if (display_width(line) <= columns) {
      out += line;
    } else {
      const std::size_t first = std::min(line.find_first_not_of(' '), columns / 2);
      const std::string indent(first, ' ');
      bool is_first = true;
      for (const std::string& part : folded_words(line.substr(first), columns - first)) {
        out += (is_first ? "" : "\n") + indent + part;
        is_first = false;
      }
    }
    if (end == std::string::npos) break;
    out += '\n';
    from = end + 1;
  }
  return out;
}

bool steers_terminal(std::string_view character) {
  if (character.size() == 1) {
    const auto c = static_cast<unsigned char>(character[0]);
    return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
  }
  if (character.size() == 2) {  // U+0080 to U+009F, the mark of Arabic letters
    return (character[0] == '\xc2' && static_cast<unsigned char>(character[1]) < 0xa0) ||
           character == "\u061c";
  }
  const auto is_from = [&](std::string_view first, std::string_view last) {
    return character.size() == 3 && first <= character && character <= last;
  };
  return is_from("\u200e", "\u200f") || is_from("\u202a", "\u202e") || is_from("\u2066", "\u2069");
}

std::string shown_text(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const bool is_ascii = static_cast<unsigned char>(text[0]) < 0x80;
    const std::size_t length = is_ascii ? 1 : character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    shown += length == 0 || steers_terminal(character) ? "\ufffd" : character;
    text.remove_prefix(character.size());
  }
  return shown;
}

std::string shown_line(std::string_view text) {
  std::string line;
  for (const char c : text) line += c == '\n' || c == '\r' ? "\ufffd" : std::string(1, c);
  return line;
}

void say(std::FILE* to, std::string_view text) {
  const std::string shown = shown_text(text);
  std::fwrite(shown.data(), 1, shown.size(), to);
}

void fill_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    (void)::open("/dev/null",
                 stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // the lowest free one
  }
}

}  // namespace whirl::inline io
