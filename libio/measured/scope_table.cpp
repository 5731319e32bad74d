#include "libio/measured/scope_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>

#include "libio/measured/csv_settings.hpp"
#include "libio/measured/sample_cell.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t time_column = 3, value_column = 4;

/// The number of "t0 = -5e-4".
std::optional<double> named_number(const std::string& cell, std::string_view name) {
  const auto mark = cell.find('=');
  if (mark == std::string::npos || plain_name(cell.substr(0, mark)) != name) return std::nullopt;
  std::string text = trimmed(std::string_view(cell).substr(mark + 1));
  if (text.ends_with('s')) text = trimmed(std::string_view(text).substr(0, text.size() - 1));
  return finite_sample_of(text);
}

std::vector<std::string> texts_of(std::string_view line) {
  std::vector<std::string> texts;
  for (Cell& cell : cells_of(line, Delimiter::comma)) texts.push_back(std::move(cell.text));
  return texts;
}

/// The header of one line.
std::optional<ScopeHeader> header_of_line(const std::vector<std::string>& cells) {
  for (std::size_t k = 1; k + 1 < cells.size(); ++k) {
    const auto start = named_number(cells[k], "t0"), step = named_number(cells[k + 1], "tinc");
    if (!start || !step || !(*step > 0.0)) continue;
    const std::vector<std::string> names(cells.begin(),
                                         cells.begin() + static_cast<std::ptrdiff_t>(k));
    return ScopeHeader{names, std::vector<std::string>(k), *start, *step, false};
  }
  return std::nullopt;
}

/// The header of two lines.
std::optional<ScopeHeader> header_of_lines(const std::vector<std::string>& names,
                                           const std::vector<std::string>& values) {
  for (std::size_t k = 2; k + 1 < std::min(names.size(), values.size()); ++k) {
    if (plain_name(names[k]) != "start" || plain_name(names[k + 1]) != "increment") continue;
    const auto start = finite_sample_of(values[k]), step = finite_sample_of(values[k + 1]);
    if (!start || !step || !(*step > 0.0)) continue;
    const auto end = static_cast<std::ptrdiff_t>(k);
    ScopeHeader header{{names.begin(), names.begin() + end},
                       {values.begin(), values.begin() + end},
                       *start,
                       *step,
                       plain_name(values.front()) == "sequence"};
    if (header.counts_samples) header.units.front() = "";
    return header;
  }
  return std::nullopt;
}

}  // namespace

bool has_scope_columns(const std::vector<CsvLine>& lines) {
  if (lines.empty()) return false;
  const std::vector<std::string> cells = texts_of(lines.front().text);
  return cells.size() > value_column && plain_name(cells[0]) == "recordlength" &&
         finite_sample_of(cells[time_column]) && finite_sample_of(cells[value_column]);
}

RawRecord scope_record(const std::vector<CsvLine>& lines, const std::string& file) {
  RawRecord raw{.file = file};
  RawChannel times{"time", "", {}, {file, lines.front().number, 1}};
  RawChannel values{"", "", {}, {file, lines.front().number, 1}};
  std::list<std::string> texts;  // that lines of settings are parts of
  std::vector<CsvLine> settings;
  NoReadings no_readings;
  for (const CsvLine& line : lines) {
    std::vector<Cell> cells = cells_of(line.text, Delimiter::comma);
    while (cells.size() > value_column + 1 && cells.back().text.empty()) cells.pop_back();
    if (cells.size() != value_column + 1) {
      throw ModelError({file, line.number, 1}, "",
                       fmt::format("found {} columns, expected a setting and its value, an empty "
                                   "column, time and value",
                                   cells.size()));
    }
    if (!cells[0].text.empty()) {
      texts.push_back(cells[0].text + "," + cells[1].text);
      settings.push_back({line.number, texts.back()});
      if (plain_name(cells[0].text) == "source") values.name = cells[1].text;
    }
    for (RawChannel* channel : {&times, &values}) {
      const Cell& cell = cells[channel == &times ? time_column : value_column];
      const auto value = sample_of(cell.text);
      if (!value) {
        throw ModelError({file, line.number, cell.place}, channel->name,
                         fmt::format("found \"{}\", expected a number", cell.text));
      }
      channel->samples.push_back(*value);
      if (channel == &values && is_no_reading(cell.text)) {
        no_readings.add(cell.text, 0, {file, line.number, cell.place});
      }
    }
  }
  CsvSettings said = csv_settings(settings, file);
  raw.rate = said.rate;
  times.unit = said.time_unit;
  if (!said.units.empty()) values.unit = said.units.front();
  if (values.name.empty()) values.name = "1";
  raw.notes = std::move(said.notes);
  raw.channels = {std::move(values)};
  no_readings.tell(raw);
  raw.channels.push_back(std::move(times));
  return raw;
}

std::optional<ScopeHeader> scope_header(const std::vector<CsvLine>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<std::string> cells = texts_of(lines[i].text);
    if (auto header = header_of_line(cells)) return header;
    if (i + 1 == lines.size()) break;
    if (auto header = header_of_lines(cells, texts_of(lines[i + 1].text))) return header;
  }
  return std::nullopt;
}

}  // namespace whirl::inline io
