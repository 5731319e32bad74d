#include "libio/model/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>

#include "libio/text/nearest.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

using Kind = CoefficientColumn::Kind;

const std::vector<CoefficientColumn>& known_columns() {
  static const std::vector<CoefficientColumn> columns = [] {
    std::vector<CoefficientColumn> all{{.name = "speed", .si_unit = "rad/s", .kind = Kind::speed},
                                       {.name = "whirl", .si_unit = "rad/s", .kind = Kind::whirl}};
    const std::tuple<const char*, const char*, Mat2 BearingCoefficients::*> groups[] = {
        {"k", "N/m", &BearingCoefficients::K},
        {"c", "N.s/m", &BearingCoefficients::C},
        {"m", "kg", &BearingCoefficients::M},
        {"kt", "N.m/rad", &BearingCoefficients::Kt},
        {"ct", "N.m.s/rad", &BearingCoefficients::Ct}};
    for (const auto& [prefix, unit, matrix] : groups) {
      for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
          all.push_back({.name = std::string(prefix) + "xy"[i] + "xy"[j],
                         .si_unit = unit,
                         .matrix = matrix,
                         .row = i,
                         .column = j});
        }
      }
    }
    return all;
  }();
  return columns;
}

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const CoefficientColumn& c : known_columns()) names.push_back(c.name);
  return names;
}

/// A name that other programs give a column, in lower case and without what stands between words.
struct Synonym {
  std::string_view written, name;
  std::string_view unit = "";  ///< that the name itself says
};
constexpr Synonym synonyms[] = {{"rpm", "speed", "rpm"},          {"n", "speed", "rpm"},
                                {"rotorspeed", "speed"},          {"shaftspeed", "speed"},
                                {"spinspeed", "speed"},           {"spin", "speed"},
                                {"runningspeed", "speed"},        {"operatingspeed", "speed"},
                                {"rotationalspeed", "speed"},     {"rotationspeed", "speed"},
                                {"rotatingspeed", "speed"},       {"hz", "whirl", "Hz"},
                                {"cpm", "whirl", "rpm"},          {"freq", "whirl"},
                                {"frequency", "whirl"},           {"whirlfreq", "whirl"},
                                {"whirlfrequency", "whirl"},      {"whirlspeed", "whirl"},
                                {"whirlingspeed", "whirl"},       {"whirlingfrequency", "whirl"},
                                {"excitation", "whirl"},          {"excfreq", "whirl"},
                                {"excitationfreq", "whirl"},      {"excitationfrequency", "whirl"},
                                {"precessionfrequency", "whirl"}, {"vibrationfrequency", "whirl"}};

std::optional<CoefficientColumn> column_of(std::string_view name) {
  std::string plain = plain_name(name);
  std::string_view unit;
  bool is_synonym = false;
  for (const Synonym& s : synonyms) {
    if (s.written != plain) continue;
    plain = s.name;
    unit = s.unit;
    is_synonym = true;
    break;
  }
  for (CoefficientColumn column : known_columns()) {
    if (column.name != plain) continue;
    column.unit = unit;
    column.needs_unit = is_synonym && unit.empty();
    return column;
  }
  return std::nullopt;
}

NameAndUnit split(const std::string& cell) {
  return name_and_unit(cell, [](const std::string& name, const std::string& unit) {
    const auto column = column_of(name);
    return column && (unit.empty() || unit_in_table(unit, column->si_unit));
  });
}

bool is_in_brackets(const std::string& word) {
  return !word.empty() && (word.front() == '[' || word.front() == '(');
}

/// Cells of a line of names. Blanks delimit, and stand within names: "Rotor speed (rpm) Kxx".
std::vector<Cell> name_cells(const std::string& line, Delimiter delimiter) {
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
    while (count > 1 && (has_brackets(i, count) || !column_of(split(joined(i, count)).name))) {
      --count;
    }
    cells.push_back({joined(i, count), words[i].place});
    i += count;
  }
  return cells;
}

void set_unit(CoefficientColumn& column, const std::string& unit, int place,
              const ReportProblem& report) {
  if (unit.empty() || unit == "-") return;
  const auto meant = unit_in_table(unit, column.si_unit);
  if (meant) {
    column.unit = *meant;
    column.needs_unit = false;
  } else {
    report(place, column.name, fmt::format("the unit [{}] does not fit: {}", unit, meant.problem));
  }
}

void report_unknown(const std::string& name, int place, const ReportProblem& report) {
  const std::vector<std::string> names = known_names();
  const auto near = nearest(plain_name(name), names);
  report(place, name,
         near ? fmt::format("unknown column, did you mean \"{}\"?", *near)
              : fmt::format("unknown column, known are {}", fmt::join(names, ", ")));
}

}  // namespace

std::size_t coefficients_named_in(const std::string& line) {
  const std::vector<Cell> cells = name_cells(line, delimiter_of(line));
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), [](const Cell& cell) {
    return column_of(split(cell.text).name).has_value();
  }));
}

std::vector<CoefficientColumn> columns_named(const std::string& line, Delimiter delimiter,
                                             const ReportProblem& report) {
  std::vector<CoefficientColumn> columns;
  const std::vector<Cell> cells = name_cells(line, delimiter);
  if (begins_as_number(cells.front().text)) {
    report(cells.front().place, "",
           fmt::format("found numbers, expected a line with the names of the columns first: {}",
                       fmt::join(known_names(), ", ")));
    return columns;
  }
  for (const Cell& cell : cells) {
    const NameAndUnit said = split(cell.text);
    const auto column = column_of(said.name);
    const bool is_remark = !column && delimiter != Delimiter::blanks && names_remarks(said.name);
    if (!column && !is_remark) report_unknown(said.name, cell.place, report);
    columns.push_back(column.value_or(CoefficientColumn{}));
    columns.back().place = cell.place;
    columns.back().is_remark = is_remark;
    if (column && said.has_unit) set_unit(columns.back(), said.unit, cell.place, report);
  }
  return columns;
}

void take_units(std::vector<CoefficientColumn>& columns, const std::vector<Cell>& cells,
                const ReportProblem& report) {
  if (cells.size() > columns.size()) {
    report(cells[columns.size()].place, "",
           fmt::format("found {} units, expected {} as there are columns", cells.size(),
                       columns.size()));
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& text = cells[i].text;
    if (columns[i].is_remark) continue;
    set_unit(columns[i], is_in_brackets(text) ? split(text).unit : text, cells[i].place, report);
  }
}

void check_columns(const std::vector<CoefficientColumn>& columns, const ReportProblem& report) {
  bool has_place = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CoefficientColumn& column = columns[i];
    has_place = has_place || column.kind != Kind::entry;
    for (std::size_t k = 0; k < i; ++k) {
      if (column.name.empty() || columns[k].name != column.name) continue;
      report(column.place, column.name, "this column is there already");
      break;
    }
    if (column.needs_unit) {
      report(column.place, column.name,
             "its unit is missing; write it behind the name, such as [rpm] or [Hz], or in a line "
             "of units below");
    }
  }
  if (!has_place) {
    report(1, "", "a column of speeds or of whirl frequencies is missing: name it speed or whirl");
  }
}

void doubt_columns(const std::vector<CoefficientColumn>& columns, const ReportProblem& report) {
  for (const CoefficientColumn& column : columns) {
    if (column.kind != Kind::entry || column.is_remark) continue;
    // the one of the other direction: kyy of kxx, kyx of kxy
    std::string other = column.name;
    for (char& c : other) c = c == 'x' ? 'y' : c == 'y' ? 'x' : c;
    const bool is_there = std::any_of(columns.begin(), columns.end(),
                                      [&](const CoefficientColumn& c) { return c.name == other; });
    if (is_there) continue;
    report(
        column.place, other,
        fmt::format("this table has no such column beside {}: it is taken as zero", column.name));
  }
}

}  // namespace whirl::inline io
