#include "libio/measured/csv_header.hpp"

#include <algorithm>

#include "libio/measured/channel_unit.hpp"
#include "libio/measured/csv_settings.hpp"
#include "libio/measured/raw_record.hpp"

namespace whirl::inline io {

namespace {

/// "[um]", "um": what stands in the brackets of a cell, if it has no more than these.
std::string bare_unit(const std::string& cell) {
  const auto first = cell.find_first_not_of("[( ");
  if (first == std::string::npos) return "";
  return trimmed(cell.substr(first, cell.find_last_not_of("]) ") - first + 1));
}

bool is_unit(const std::string& cell) {
  const bool is_in_brackets = cell.starts_with('[') || cell.starts_with('(');
  const std::string unit = bare_unit(cell);
  if (is_in_brackets || unit.empty() || unit == "-") return true;
  const ChannelUnit known = channel_unit(unit);
  return known.name == "m" || known.name == "V" || seconds_in(unit).value.has_value();
}

/// Names between blanks, "x [um] y [um]"; a line of units stays as it is.
std::vector<Cell> with_their_units(const std::vector<Cell>& cells) {
  const auto is_unit_alone = [](const Cell& c) {
    return c.text.starts_with('[') || c.text.starts_with('(');
  };
  std::vector<Cell> names;
  for (const Cell& cell : cells) {
    if (names.empty() || is_unit_alone(names.back()) || !is_unit_alone(cell)) {
      names.push_back(cell);
    } else {
      names.back().text += " " + cell.text;
    }
  }
  return names;
}

/// Cells of a line with as many as there are channels, in whatever way they are delimited.
std::vector<std::string> header_cells(std::string_view line, std::size_t count,
                                      bool may_have_one_more) {
  const auto begin = line.find_first_not_of("#%! ");
  if (begin == std::string_view::npos) return {};
  for (const Delimiter delimiter : csv_delimiters) {
    std::vector<Cell> cells = cells_of(line.substr(begin), delimiter);
    const bool has_end = may_have_one_more || (!cells.empty() && cells.back().text.empty());
    if (cells.size() == count + 1 && has_end) cells.pop_back();
    if (delimiter == Delimiter::blanks) cells = with_their_units(cells);
    if (cells.size() != count) continue;
    std::vector<std::string> texts;
    for (const Cell& cell : cells) texts.push_back(cell.text);
    return texts;
  }
  return {};
}

void take_names(CsvHeader& header, const std::vector<std::string>& cells) {
  header.names.assign(cells.size(), "");
  header.units.assign(cells.size(), "");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const NameAndUnit found = name_and_unit(
        cells[i],
        [](const std::string&, const std::string& unit) { return !unit.empty() && is_unit(unit); });
    header.names[i] = found.name;
    header.units[i] = found.unit;
  }
}

}  // namespace

std::vector<CsvLine> csv_lines(std::string_view text) {
  std::vector<CsvLine> lines;
  int number = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) lines.push_back({number, line});
  }
  return lines;
}

CsvHeader csv_header(const std::vector<CsvLine>& lines, std::size_t count, bool may_have_one_more) {
  CsvHeader header;
  for (const CsvLine& line : lines) {
    if (is_csv_setting(line.text)) continue;
    const std::vector<std::string> cells = header_cells(line.text, count, may_have_one_more);
    if (cells.empty()) continue;
    if (!header.names.empty() && std::all_of(cells.begin(), cells.end(), is_unit)) {
      for (std::size_t i = 0; i < count; ++i) header.units[i] = bare_unit(cells[i]);
    } else {
      take_names(header, cells);
    }
  }
  header.names.resize(count);
  header.units.resize(count);
  header.has_names = std::any_of(header.names.begin(), header.names.end(),
                                 [](const std::string& name) { return !name.empty(); });
  for (std::size_t i = 0; header.has_names && i < count; ++i) {
    if (header.names[i].empty()) header.names[i] = std::to_string(i + 1);
  }
  return header;
}

}  // namespace whirl::inline io
