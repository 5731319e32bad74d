#include "libio/text/delimited.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace whirl::inline io {

namespace {

bool is_numeral(char c) {
  return c >= '0' && c <= '9';
}

/// Calls f(character, place) for what is in no quotes and no brackets.
template <class F>
void for_each_outside(std::string_view line, F f) {
  bool is_quoted = false;
  int depth = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (c == '(' || c == '[') ++depth;
    if ((c == ')' || c == ']') && depth > 0) --depth;
    if (depth == 0) f(c, i);
  }
}

bool delimits(char c, Delimiter delimiter) {
  switch (delimiter) {
    case Delimiter::comma:
      return c == ',' || c == ';';
    case Delimiter::semicolon:
      return c == ';';
    case Delimiter::tab:
      return c == '\t';
    case Delimiter::blanks:
      return c == ' ' || c == '\t';
  }
  return false;
}

}  // namespace

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

Delimiter delimiter_of(std::string_view line) {
  bool has_semicolon = false, has_tab = false, has_comma = false;
  // a tab before the first name or behind the last delimits nothing
  const auto first = std::min(line.find_first_not_of(" \t\r"), line.size());
  const auto last = line.find_last_not_of(" \t\r");
  for_each_outside(line.substr(first, last + 1 - first), [&](char c, std::size_t) {
    has_semicolon = has_semicolon || c == ';';
    has_tab = has_tab || c == '\t';
    has_comma = has_comma || c == ',';
  });
  if (has_semicolon) return Delimiter::semicolon;
  if (has_comma) return Delimiter::comma;
  return has_tab ? Delimiter::tab : Delimiter::blanks;
}

std::vector<std::string> cells_of(std::string_view line, Delimiter delimiter) {
  std::vector<std::string> cells;
  std::size_t start = 0;
  const auto add = [&](std::size_t end) {
    const std::string cell = trimmed(line.substr(start, end - start));
    if (!cell.empty() || delimiter != Delimiter::blanks) cells.push_back(cell);
    start = end + 1;
  };
  for_each_outside(line, [&](char c, std::size_t i) {
    if (delimits(c, delimiter)) add(i);
  });
  if (start <= line.size()) add(line.size());
  return cells;
}

Parsed<std::string> plain_number(std::string_view cell, Delimiter delimiter) {
  using Result = Parsed<std::string>;
  std::string text(cell);
  const auto end = std::min(text.find_first_not_of("+-0123456789.,eEdD"), text.size());
  for (std::size_t i = 1; i + 1 < end; ++i) {
    const bool is_exponent = (text[i] == 'd' || text[i] == 'D') &&
                             (is_numeral(text[i - 1]) || text[i - 1] == '.') &&
                             (is_numeral(text[i + 1]) || text[i + 1] == '+' || text[i + 1] == '-');
    if (is_exponent) text[i] = 'E';
  }
  const auto comma = text.find(',');
  const bool is_decimal = delimiter != Delimiter::comma && comma < end &&
                          text.find(',', comma + 1) >= end && text.find('.') >= end;
  if (!is_decimal) return text;
  std::size_t digits = 0;
  while (comma + 1 + digits < text.size() && is_numeral(text[comma + 1 + digits])) ++digits;
  if (delimiter != Delimiter::semicolon && digits == 3) {
    return Result::failed(
        fmt::format("the comma in {} may be that of decimals or of thousands; write a point, or "
                    "semicolons between the columns",
                    in_quotes(cell)));
  }
  text[comma] = '.';
  return text;
}

}  // namespace whirl::inline io
