#include "libio/model/named_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libio/model/column_names.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

/// Whether a column's own name is one that plain_name gives.
bool is_own_name(std::string_view name, std::string_view plain) {
  std::size_t at = 0;
  for (const char c : name) {
    if (c == '_') continue;
    if (at == plain.size() || plain[at++] != c) return false;
  }
  return at == plain.size();
}

/// What a name means in a table of these kinds.
NamedColumn meaning_of(const std::string& name, const std::vector<ColumnKind>& kinds) {
  const std::string plain = plain_name(name);
  const auto find = [&](const auto& is_it) {
    const auto found = std::find_if(kinds.begin(), kinds.end(), is_it);
    return found == kinds.end() ? nullptr : &*found;
  };
  if (const auto* kind = find([&](const ColumnKind& k) { return is_own_name(k.name, plain); })) {
    return {.kind = kind};
  }
  for (const ColumnName& called : columns_called(plain)) {
    const auto* kind = find([&](const ColumnKind& k) { return k.name == called.column; });
    if (!kind) continue;
    const bool says_unit = !called.unit.empty() && !kind->is_text;
    return {.kind = kind,
            .unit = says_unit ? std::string(called.unit) : "",
            .needs_unit = kind->others_need_unit && !says_unit};
  }
  return {};
}

/// Name and unit of a cell of the line of names.
NameAndUnit said_in(const std::string& cell, const std::vector<ColumnKind>& kinds) {
  return name_and_unit(cell, [&](const std::string& name, const std::string& unit) {
    const ColumnKind* kind = meaning_of(name, kinds).kind;
    if (!kind || unit.empty()) return kind != nullptr;
    return kind->keeps_unit || (!kind->is_text && unit_in_table(unit, kind->unit));
  });
}

bool is_known(const std::string& cell, const std::vector<ColumnKind>& kinds) {
  return meaning_of(said_in(cell, kinds).name, kinds).kind != nullptr;
}

bool is_in_brackets(const std::string& word) {
  return !word.empty() && (word.front() == '[' || word.front() == '(');
}

/// What stands in brackets, or the text where there are none.
std::string out_of_brackets(const std::string& text) {
  if (!is_in_brackets(text)) return text;
  const auto end = text.find_last_of("])");
  return trimmed(std::string_view(text).substr(1, end == std::string::npos ? end : end - 1));
}

/// Cells of a line of names. Blanks delimit, and stand within names: "Rotor speed (rpm) Kxx".
std::vector<Cell> name_cells(const std::string& line, Delimiter delimiter,
                             const std::vector<ColumnKind>& kinds) {
  std::vector<Cell> words = cells_of(line, delimiter);
  while (words.size() > 1 && words.back().text.empty()) words.pop_back();
  if (delimiter != Delimiter::blanks) return words;
  constexpr std::size_t most_words = 3;
  const auto joined = [&](std::size_t first, std::size_t count) {
    std::string all = words[first].text;
    for (std::size_t k = 1; k < count; ++k) all += " " + words[first + k].text;
    return all;
  };
  const auto has_brackets = [&](std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      if (is_in_brackets(words[first + k].text)) return true;
    }
    return false;
  };
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < words.size();) {
    if (is_in_brackets(words[i].text) && !cells.empty()) {
      cells.back().text += " " + words[i++].text;
      continue;
    }
    std::size_t count = std::min(most_words, words.size() - i);
    while (count > 1 && (has_brackets(i, count) || !is_known(joined(i, count), kinds))) --count;
    cells.push_back({joined(i, count), words[i].place});
    i += count;
  }
  return cells;
}

std::size_t known_in(const std::string& line, Delimiter delimiter,
                     const std::vector<ColumnKind>& kinds) {
  const std::vector<Cell> cells = name_cells(line, delimiter, kinds);
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const Cell& cell) { return is_known(cell.text, kinds); }));
}

std::vector<std::string> names_of(const std::vector<ColumnKind>& kinds) {
  std::vector<std::string> names;
  for (const ColumnKind& kind : kinds) names.push_back(kind.name);
  return names;
}

/// A name that is nearly that of a column is a mistake; others are of columns that nobody reads.
void report_unknown(const std::string& name, int place, const std::vector<ColumnKind>& kinds,
                    const ReportProblem& report, const ReportProblem& doubt) {
  constexpr std::size_t least_letters = 5;  // shorter ones are near to anything
  const std::vector<std::string> names = names_of(kinds);
  std::string written = lower_case(name);
  for (char& c : written) c = c == ' ' || c == '-' ? '_' : c;
  const auto near = name.size() < least_letters ? std::nullopt : nearest(written, names);
  if (near && near->front() == written.front()) {  // "weight" is no mistake for "length"
    report(place, name, fmt::format("unknown column, did you mean \"{}\"?", *near));
  } else if (doubt) {
    doubt(
        place, name,
        fmt::format("this column is not known and not read; known are {}", fmt::join(names, ", ")));
  }
}

/// Gives a column the unit that a cell says; whether it fits.
bool take_unit(NamedColumn& column, const std::string& unit, int place,
               const ReportProblem& report) {
  if (!column.kind || unit.empty() || unit == "-") return true;
  const ColumnKind& kind = *column.kind;
  if (kind.keeps_unit) {
    column.unit = unit;
    return true;
  }
  if (kind.is_text) {
    report(place, kind.name,
           kind.unit_problem.empty() ? "a column of words has no unit" : kind.unit_problem);
    return false;
  }
  const auto meant = unit_in_table(unit, kind.unit);
  if (!meant) {
    report(place, kind.name, fmt::format("the unit [{}] does not fit: {}", unit, meant.problem));
    return false;
  }
  column.unit = *meant;
  column.needs_unit = false;
  return true;
}

/// The column of a cell of the line of names.
NamedColumn column_named(const Cell& cell, const std::vector<ColumnKind>& kinds,
                         const ReportProblem& report, const ReportProblem& doubt) {
  const NameAndUnit said = said_in(cell.text, kinds);
  NamedColumn column = meaning_of(said.name, kinds);
  column.place = cell.place;
  if (!column.kind) {
    const bool is_silent = said.name.empty() || names_remarks(plain_name(said.name));
    if (!is_silent) report_unknown(said.name, cell.place, kinds, report, doubt);
  } else if (said.has_unit) {
    take_unit(column, said.unit, cell.place, report);
  }
  return column;
}

}  // namespace

Delimiter delimiter_of_names(const std::string& line, const std::vector<ColumnKind>& kinds) {
  const Delimiter found = delimiter_of(line);
  if (found != Delimiter::blanks || known_in(line, Delimiter::blanks, kinds) > 1) return found;
  return Delimiter::comma;
}

std::size_t columns_named_in(const std::string& line, const std::vector<ColumnKind>& kinds) {
  return known_in(line, delimiter_of_names(line, kinds), kinds);
}

std::vector<NamedColumn> named_columns(const std::string& line, Delimiter delimiter,
                                       const std::vector<ColumnKind>& kinds,
                                       const ReportProblem& report, const ReportProblem& doubt) {
  const std::vector<Cell> cells = name_cells(line, delimiter, kinds);
  if (begins_as_number(cells.front().text)) {
    report(cells.front().place, "",
           fmt::format("found numbers, expected a line with the names of the columns first: {}",
                       fmt::join(names_of(kinds), ", ")));
    return {};
  }
  std::vector<NamedColumn> columns;
  for (const Cell& cell : cells) {
    NamedColumn column = column_named(cell, kinds, report, doubt);
    const bool is_double =
        column.kind && std::any_of(columns.begin(), columns.end(),
                                   [&](const NamedColumn& c) { return c.kind == column.kind; });
    if (is_double) report(cell.place, column.kind->name, "this column is there already");
    columns.push_back(std::move(column));
  }
  return columns;
}

bool take_units(std::vector<NamedColumn>& columns, const std::vector<Cell>& cells,
                const ReportProblem& report) {
  if (!is_line_of_units(cells)) return false;
  const ReportProblem nobody = [](int, const std::string&, const std::string&) {};
  const std::size_t count = std::min(columns.size(), cells.size());
  std::size_t fitting = 0, not_fitting = 0;
  std::vector<NamedColumn> with_units = columns;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string unit = out_of_brackets(cells[i].text);
    if (!columns[i].kind || unit.empty() || unit == "-") continue;
    ++(take_unit(with_units[i], unit, cells[i].place, nobody) ? fitting : not_fitting);
  }
  if (fitting == 0) return false;
  if (not_fitting == 0) {
    columns = std::move(with_units);
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    take_unit(columns[i], out_of_brackets(cells[i].text), cells[i].place, report);
  }
  return true;
}

}  // namespace whirl::inline io
