#include "libio/text/line_kinds.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace whirl::inline io {

namespace {

/// Whether a cell begins with a date: "2026-11-29", "29.11.2026 14:30".
bool is_date(std::string_view cell) {
  std::array<std::size_t, 3> digits{};
  char between = 0;
  for (std::size_t part = 0; part < digits.size(); ++part) {
    const std::size_t end = std::min(cell.find_first_not_of("0123456789"), cell.size());
    digits[part] = end;
    cell.remove_prefix(end);
    if (part == 2) break;
    const bool separates = !cell.empty() && std::string_view("-./").find(cell[0]) != cell.npos;
    if (!separates || (part == 1 && cell[0] != between)) return false;
    between = cell[0];
    cell.remove_prefix(1);
  }
  const auto [first, second, third] = digits;
  const auto is_short = [](std::size_t n) { return n == 1 || n == 2; };
  const bool begins_with_year = first == 4 && is_short(third);
  const bool ends_with_year = is_short(first) && (third == 4 || third == 2);
  const bool ends = cell.empty() || cell[0] == ' ' || cell[0] == 'T';
  return ends && is_short(second) && (begins_with_year || ends_with_year);
}

bool begins_with_one_of(const Cell& cell, std::span<const std::string_view> words) {
  const std::string plain = plain_name(cell.text);
  return std::ranges::any_of(words, [&](auto word) { return plain.starts_with(word); });
}

}  // namespace

std::size_t numeral_end(std::string_view cell) {
  return std::min(cell.find_first_not_of("+-0123456789.,eEdD"), cell.size());
}

bool is_row_of_numbers(const std::string& line) {
  const std::vector<Cell> cells = cells_of(line, delimiter_of(line));
  const auto filled = std::ranges::count_if(cells, [](const Cell& c) { return !c.text.empty(); });
  const auto is_number = [](const Cell& c) {
    if (!begins_as_number(c.text) || is_date(c.text)) return false;
    const std::string_view rest = std::string_view(c.text).substr(numeral_end(c.text));
    return rest.find_first_of("/:") != 0 && trimmed(rest).find(' ') == std::string::npos;
  };
  const auto numbers = std::ranges::count_if(cells, is_number);
  return numbers > 0 && 2 * numbers >= filled;
}

bool is_note(const std::vector<Cell>& cells, std::size_t columns, Delimiter delimiter) {
  const auto is_empty = [](const Cell& cell) { return cell.text.empty(); };
  const auto filled =
      cells.size() - static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), is_empty));
  // in a sheet a table may begin at any column
  const bool begins =
      delimiter == Delimiter::cell ? filled > 0 : !cells.empty() && !is_empty(cells.front());
  return filled < columns && begins &&
         std::none_of(cells.begin(), cells.end(),
                      [](const Cell& cell) { return begins_as_number(cell.text); });
}

bool is_total(const std::vector<Cell>& cells, std::size_t columns) {
  static constexpr std::string_view words[] = {"total", "sum", "gesamt", "somme", "soma", "suma"};
  const auto filled = std::ranges::count_if(cells, [](const Cell& c) { return !c.text.empty(); });
  return filled < static_cast<std::ptrdiff_t>(columns) &&
         std::ranges::any_of(cells, [](const Cell& c) { return begins_with_one_of(c, words); });
}

bool is_statistic(const std::vector<Cell>& cells, const std::vector<Cell>& above) {
  static constexpr std::string_view words[] = {
      "total",    "sum",  "mean",   "average", "min",     "max",          "std",
      "standard", "rms",  "median", "gesamt",  "mittel",  "durchschnitt", "somme",
      "moyenne",  "soma", "suma",   "media",   "promedio"};
  for (std::size_t i = 0; i < std::min(cells.size(), above.size()); ++i) {
    if (begins_as_number(above[i].text) && begins_with_one_of(cells[i], words)) return true;
  }
  return false;
}

}  // namespace whirl::inline io
