#include "libio/model/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
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

/// A name in lower case, without what stands between its words.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (std::string_view(" \t_-.").find(c) != std::string_view::npos) continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

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

/// What a cell of the line of names says.
struct NameAndUnit {
  std::string name, unit;
  bool has_unit = false;
};

/// Takes a unit in brackets off a cell; one without brackets only if nothing else is known.
NameAndUnit split(const std::string& cell) {
  const auto bracket = cell.find_first_of("[(");
  if (bracket != std::string::npos) {
    const auto end = cell.find_last_of("])");
    const auto from = bracket + 1;
    const auto size = end == std::string::npos || end < from ? std::string::npos : end - from;
    return {trimmed(std::string_view(cell).substr(0, bracket)),
            trimmed(std::string_view(cell).substr(from, size)), true};
  }
  if (column_of(cell)) return {cell, "", false};
  for (const char* between : {" ", "_", ","}) {
    const auto at = cell.find(between);
    if (at == std::string::npos) continue;
    const std::string name = cell.substr(0, at), unit = trimmed(cell.substr(at + 1));
    const auto column = column_of(name);
    if (column && unit_in_table(unit, column->si_unit)) return {name, unit, true};
  }
  return {cell, "", false};
}

bool is_in_brackets(const std::string& word) {
  return !word.empty() && (word.front() == '[' || word.front() == '(');
}

/// Cells of a line of names. Blanks delimit, and stand within names: "Rotor speed (rpm) Kxx".
std::vector<std::string> name_cells(const std::string& line, Delimiter delimiter) {
  std::vector<std::string> words = cells_of(line, delimiter);
  while (words.size() > 1 && words.back().empty()) words.pop_back();
  if (delimiter != Delimiter::blanks) return words;
  constexpr std::size_t most_words = 3;
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < words.size();) {
    if (is_in_brackets(words[i]) && !cells.empty()) {
      cells.back() += " " + words[i++];
      continue;
    }
    std::size_t taken = 1;
    for (std::size_t count = std::min(most_words, words.size() - i); count > 1; --count) {
      const auto first = words.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::any_of(first, first + static_cast<std::ptrdiff_t>(count), is_in_brackets)) continue;
      const std::string joined =
          fmt::format("{}", fmt::join(first, first + static_cast<std::ptrdiff_t>(count), " "));
      if (!column_of(split(joined).name)) continue;
      taken = count;
      break;
    }
    std::string cell = words[i];
    for (std::size_t k = 1; k < taken; ++k) cell += " " + words[i + k];
    cells.push_back(cell);
    i += taken;
  }
  return cells;
}

void set_unit(CoefficientColumn& column, const std::string& unit, const ReportProblem& report) {
  if (unit.empty() || unit == "-") return;
  const auto meant = unit_in_table(unit, column.si_unit);
  if (meant) {
    column.unit = *meant;
    column.needs_unit = false;
  } else {
    report(column.name, fmt::format("the unit [{}] does not fit: {}", unit, meant.problem));
  }
}

}  // namespace

std::vector<CoefficientColumn> columns_named(const std::string& line, Delimiter delimiter,
                                             const ReportProblem& report) {
  std::vector<CoefficientColumn> columns;
  for (const std::string& cell : name_cells(line, delimiter)) {
    const NameAndUnit said = split(cell);
    const auto column = column_of(said.name);
    if (!column) {
      const std::vector<std::string> names = known_names();
      const auto near = nearest(plain_name(said.name), names);
      report(said.name, near ? fmt::format("unknown column, did you mean \"{}\"?", *near)
                             : fmt::format("unknown column, known are {}", fmt::join(names, ", ")));
    }
    columns.push_back(column.value_or(CoefficientColumn{}));
    if (column && said.has_unit) set_unit(columns.back(), said.unit, report);
  }
  return columns;
}

bool is_line_of_units(const std::vector<std::string>& cells) {
  bool has_any = false;
  for (const std::string& cell : cells) {
    if (cell.empty() || cell == "-") continue;
    const bool is_one_over = cell.starts_with("1/");
    const char first = is_in_brackets(cell) ? 'x' : cell.front();
    const bool is_number = std::string_view("+-.0123456789").find(first) != std::string_view::npos;
    if (is_number && !is_one_over) return false;
    // what is no number and no unit, such as nan, is reported as a value
    static constexpr std::string_view never[] = {"nan", "inf", "infinity"};
    if (std::find(std::begin(never), std::end(never), plain_name(cell)) != std::end(never)) {
      return false;
    }
    has_any = true;
  }
  return has_any;
}

void take_units(std::vector<CoefficientColumn>& columns, const std::vector<std::string>& cells,
                const ReportProblem& report) {
  if (cells.size() > columns.size()) {
    report("", fmt::format("found {} units, expected {} as there are columns", cells.size(),
                           columns.size()));
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_bracketed = is_in_brackets(cells[i]);
    set_unit(columns[i], is_bracketed ? split(cells[i]).unit : cells[i], report);
  }
}

void check_columns(const std::vector<CoefficientColumn>& columns, const ReportProblem& report) {
  bool has_place = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const CoefficientColumn& column = columns[i];
    has_place = has_place || column.kind != Kind::entry;
    for (std::size_t k = 0; k < i; ++k) {
      if (column.name.empty() || columns[k].name != column.name) continue;
      report(column.name, "this column is there already");
      break;
    }
    if (column.needs_unit) {
      report(column.name,
             "its unit is missing; write it behind the name, such as [rpm] or [Hz], or in a line "
             "of units below");
    }
  }
  if (!has_place) {
    report("", "a column of speeds or of whirl frequencies is missing: name it speed or whirl");
  }
}

}  // namespace whirl::inline io
