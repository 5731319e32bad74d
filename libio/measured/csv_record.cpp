/// Tables as data loggers write them.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/csv_samples.hpp"
#include "libio/measured/csv_settings.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/measured/scope_table.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view csv_record_head = "# measurement, written by whirl\n";

/// "50 000": what stands between tabs is one number, not two.
bool has_blank_of_thousands(const std::string& cell) {
  const auto blank = cell.find(' ');
  if (blank == std::string::npos || !begins_as_number(cell)) return false;
  const auto end = std::min(cell.find_first_not_of("0123456789", blank + 1), cell.size());
  return end == blank + 4;
}

/// The form in which a line is one of numbers, one at least; nothing: it is none.
/// @param may_end_with_words  the last cell may be a remark
std::optional<CsvForm> number_form(std::string_view line, bool may_end_with_words = false) {
  for (const Delimiter delimiter : csv_delimiters) {
    std::vector<Cell> cells = cells_of(line, delimiter);
    // a lone number is one whatever delimits it
    if (cells.size() < 2 && delimiter != Delimiter::blanks) continue;
    const bool has_blanks_of_thousands =
        delimiter == Delimiter::tab && std::any_of(cells.begin(), cells.end(), [](const Cell& c) {
          return has_blank_of_thousands(c.text);
        });
    if (has_blanks_of_thousands) return std::nullopt;
    const bool has_words = may_end_with_words && cells.size() > 2 && is_remark(cells.back());
    const bool has_end = has_words || (cells.size() > 2 && cells.back().text.empty());
    if (has_end) cells.pop_back();
    bool has_number = false, is_right = true;
    for (const Cell& cell : cells) {
      const auto value = sample_of(cell.text);
      is_right = is_right && (value || is_sample(cell.text));
      has_number = has_number || (value && std::isfinite(*value));
    }
    if (is_right && has_number) return CsvForm{delimiter, has_end, cells.size()};
  }
  return std::nullopt;
}

/// The lines of a table: how its numbers stand, and which lines they are.
struct CsvBody {
  CsvForm form;
  std::size_t first = 0;  ///< line of numbers that another one follows, or that is the last
};

/// @return  nothing: there is no line of numbers
std::optional<CsvBody> body_of(const std::vector<CsvLine>& lines) {
  for (const bool may_end_with_words : {false, true}) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto form = number_form(lines[i].text, may_end_with_words);
      if (!form) continue;
      const bool is_last = i + 1 == lines.size();
      if (is_last || number_form(lines[i + 1].text, may_end_with_words)) return CsvBody{*form, i};
    }
  }
  return std::nullopt;
}

/// Whether a cell names a row of statistics: "Min", "Std. Dev.:".
bool names_statistics(const std::string& cell) {
  static constexpr std::array<std::string_view, 32> names{
      "min",   "minimum",     "max",        "maximum",  "mean",         "average",
      "avg",   "rms",         "std",        "stddev",   "stdev",        "standarddeviation",
      "sigma", "sum",         "median",     "range",    "peaktopeak",   "pktopk",
      "pkpk",  "pp",          "peak",       "variance", "var",          "count",
      "crest", "crestfactor", "mittelwert", "mittel",   "effektivwert", "standardabweichung",
      "summe", "samples"};
  std::string name = plain_name(cell);
  while (name.ends_with(':') || name.ends_with('=')) name.pop_back();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a line below the numbers is none of these: words, or statistics with their name before
/// or, where the table has words behind its numbers, behind.
bool is_below(const CsvLine& line, const CsvForm& form) {
  const std::vector<Cell> cells = cells_of(line.text, form.delimiter);
  const auto is_filled = [](const Cell& cell) { return !cell.text.empty(); };
  const auto first = std::find_if(cells.begin(), cells.end(), is_filled);
  if (first == cells.end()) return false;
  if (names_statistics(first->text)) return true;
  if (form.ends_with_delimiter && cells.size() > form.columns &&
      names_statistics(cells.back().text)) {
    return true;
  }
  return std::all_of(cells.begin(), cells.end(),
                     [](const Cell& cell) { return cell.text.empty() || is_remark(cell); });
}

/// Makes what is behind the last delimiter a column, if any line has a number there.
void take_last_column(CsvForm& form, const std::vector<CsvLine>& lines, std::size_t first) {
  if (!form.ends_with_delimiter) return;
  const bool has_numbers = std::any_of(
      lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(), [&](const CsvLine& line) {
        const std::vector<Cell> cells = cells_of(line.text, form.delimiter);
        return cells.size() == form.columns + 1 && begins_as_number(cells.back().text);
      });
  if (!has_numbers) return;
  form.ends_with_delimiter = false;
  ++form.columns;
}

/// What is said of a table without numbers: the first cell that is none, of the last line.
ModelError no_numbers(const std::string& file, const std::vector<CsvLine>& lines) {
  const std::string message = "has no two lines of numbers, expected a column for each channel";
  if (lines.empty()) return ModelError({file}, "", "is empty: " + message);
  for (const Delimiter delimiter : csv_delimiters) {
    if (delimiter == Delimiter::blanks) continue;
    const std::vector<Cell> cells = cells_of(lines.back().text, delimiter);
    if (cells.size() < 2) continue;
    for (const Cell& cell : cells) {
      if (is_sample(cell.text)) continue;
      return ModelError(
          {file, lines.back().number, cell.place}, "",
          fmt::format("{}; {} in the last line is none", message, in_quotes(cell.text)));
    }
  }
  return ModelError({file}, "", message);
}

/// Whether a line names columns: none of its cells is a number, and it is no setting.
bool names_columns(std::string_view line, const std::vector<Cell>& cells) {
  return !is_csv_setting(line) && std::none_of(cells.begin(), cells.end(), [](const Cell& c) {
    return c.text.empty() || begins_as_number(c.text);
  });
}

/// Decimal commas between commas cannot be told from these: there are more columns than names, and
/// no number has a point.
/// @param cells  of the first line of numbers
void require_other_delimiters(const std::string& file, const CsvLine& header,
                              const std::vector<Cell>& cells) {
  const std::vector<Cell> names = cells_of(header.text, Delimiter::comma);
  const bool have_points = std::any_of(cells.begin(), cells.end(), [](const Cell& c) {
    return c.text.find('.') != std::string::npos;
  });
  if (have_points || cells.size() <= names.size() || cells.size() > 2 * names.size() ||
      !names_columns(header.text, names)) {
    return;
  }
  throw ModelError(
      {file, header.number, 1}, "",
      fmt::format("names {} column{}, and the lines of numbers have {}: decimal commas "
                  "cannot be told from commas between columns, expected decimal "
                  "points, or semicolons between columns",
                  names.size(), names.size() == 1 ? "" : "s", cells.size()));
}

/// Takes start and step of an oscilloscope, whose first column may count samples.
void take_scope_times(RawRecord& raw, const ScopeHeader& scope) {
  if (!scope.counts_samples) {
    raw.rate = 1.0 / scope.step;
    raw.start = scope.start;
    return;
  }
  RawChannel& numbers = raw.channels.front();
  numbers.name = "time";
  numbers.unit = "s";
  for (double& number : numbers.samples) number = scope.start + scope.step * number;
}

/// Gives channels that have none the units of the settings, and says where lines are missing.
void take_units(RawRecord& raw, const CsvSettings& said) {
  std::size_t next = 0;
  std::size_t samples = 0;
  for (RawChannel& c : raw.channels) {
    samples = c.samples.size();
    const bool is_time = names_time(c.name);
    if (is_time && c.unit.empty()) c.unit = said.time_unit;
    if (is_time || said.units.empty()) continue;
    if (c.unit.empty()) c.unit = said.units[std::min(next, said.units.size() - 1)];
    ++next;
  }
  if (!said.length || static_cast<double>(samples) >= *said.length) return;
  raw.notes.push_back(
      fmt::format("Record Length says {:g} samples, {} are there: is the file cut "
                  "off?",
                  *said.length, samples));
}

}  // namespace

RawRecord read_csv_record(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto text = in_utf8(record_bytes(path));
  if (!text) throw ModelError({file}, "", text.problem);
  return read_csv_text(*text, file);
}

bool has_csv_numbers(const std::string& text) {
  return body_of(csv_lines(text)).has_value();
}

RawRecord read_csv_text(const std::string& text, const std::string& file) {
  std::vector<CsvLine> lines = csv_lines(text);
  if (has_scope_columns(lines)) return scope_record(lines, file);
  const auto body = body_of(lines);
  if (!body) throw no_numbers(file, lines);
  auto [form, first] = *body;
  while (lines.size() > first + 1 && is_below(lines.back(), form)) lines.pop_back();
  take_last_column(form, lines, first);
  const std::vector<CsvLine> above{lines.begin(),
                                   lines.begin() + static_cast<std::ptrdiff_t>(first)};
  CsvSettings said = csv_settings(above, file);
  const auto scope = scope_header(above);
  if (scope) form.columns = scope->names.size();
  const CsvHeader header = scope ? CsvHeader{scope->names, scope->units, true}
                                 : csv_header(above, form.columns, form.ends_with_delimiter);
  if (!header.has_names && first > 0 && form.delimiter == Delimiter::comma) {
    require_other_delimiters(file, lines[first - 1], csv_cells(lines[first].text, form));
  }
  RawRecord raw{.file = file, .rate = said.rate, .start = said.start, .notes = said.notes};
  raw.no_rate_because = said.doubt;
  for (std::size_t i = 0; i < form.columns; ++i) {
    raw.channels.push_back({header.names[i], header.units[i], {}, {file, lines[first].number, 1}});
    raw.channels[i].samples.reserve(lines.size() - first);
  }
  CsvSamples samples(raw, form, header.has_names);
  for (std::size_t i = first; i < lines.size(); ++i) samples.add(lines[i], lines[first].number);
  samples.finish();
  if (scope) take_scope_times(raw, *scope);
  take_units(raw, said);
  return raw;
}

void write_csv_record(const std::filesystem::path& path, const MeasuredRecord& record,
                      Replaces replaces) {
  replace_file(
      path,
      [&](std::ostream& out) {
        out << csv_record_head << fmt::format("# sample rate [Hz]: {}\n", record.rate)
            << "time [s]";
        for (const MeasuredChannel& c : record.channels) {
          // brackets at the end of a name are no unit, if others follow
          const bool has_brackets = c.name.find_first_of("[(") != std::string::npos;
          const bool has_unit = !c.unit.empty() || has_brackets;
          out << ',' << csv_quoted(c.name + (has_unit ? fmt::format(" [{}]", c.unit) : ""));
        }
        out << '\n';
        for (Eigen::Index j = 0; j < record.samples.rows(); ++j) {
          std::string line = fmt::format("{}", record.time(j));
          for (Eigen::Index c = 0; c < record.samples.cols(); ++c) {
            const double value = record.samples(j, c);
            line += std::isnan(value) ? "," : fmt::format(",{}", value);
          }
          out << line << '\n';
        }
      },
      replaces_own(path, csv_record_head, replaces));
}

}  // namespace whirl::inline io
