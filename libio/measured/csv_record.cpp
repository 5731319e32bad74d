/// Tables as data loggers write them.

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "libbase/constants.hpp"
#include "libio/measured/channel_unit.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view csv_record_head = "# measurement, written by whirl\n";

/// A line of the file.
struct CsvLine {
  int number = 0;  ///< from 1
  std::string_view text;
};

/// How numbers stand in a table.
struct CsvForm {
  Delimiter delimiter = Delimiter::comma;
  bool has_decimal_commas = false;
  bool ends_with_delimiter = false;  ///< each line
};

/// Text in UTF-8, as spreadsheets save in UTF-16, too.
/// @throws ModelError  for UTF-16 that is none
std::string in_utf8(std::string text, const std::string& file) {
  if (!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF")) return text;
  const auto failed = [&] {
    return ModelError({file}, "", "begins as UTF-16 and is none: expected text in UTF-8");
  };
  const iconv_t converter = iconv_open("UTF-8", "UTF-16");
  if (converter == reinterpret_cast<iconv_t>(-1)) throw failed();
  std::string found(2 * text.size(), '\0');  // two bytes become three at most
  char *from = text.data(), *to = found.data();
  std::size_t left = text.size(), room = found.size();
  const std::size_t result = iconv(converter, &from, &left, &to, &room);
  iconv_close(converter);
  if (result == static_cast<std::size_t>(-1)) throw failed();
  found.resize(found.size() - room);
  return found;
}

std::vector<CsvLine> csv_lines(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
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

/// What stands for a sample that is not there.
bool is_missing(const std::string& cell) {
  static constexpr std::array<std::string_view, 6> marks{"", "nan", "na", "n/a", "null", "-"};
  std::string name = cell;
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(marks.begin(), marks.end(), name) != marks.end();
}

/// The number of a cell; NaN for a missing one, nothing for any other text.
std::optional<double> sample_of(std::string cell, bool has_decimal_commas) {
  if (is_missing(cell)) return nan;
  if (has_decimal_commas) std::replace(cell.begin(), cell.end(), ',', '.');
  const char* begin = cell.data() + (cell.front() == '+' ? 1 : 0);
  const char* end = cell.data() + cell.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return std::isfinite(value) ? value : nan;
}

/// Cells of a line of a form, without the empty one behind a delimiter at its end.
std::vector<Cell> csv_cells(std::string_view line, const CsvForm& form) {
  std::vector<Cell> cells = cells_of(line, form.delimiter);
  if (form.ends_with_delimiter && !cells.empty() && cells.back().text.empty()) cells.pop_back();
  return cells;
}

/// In the order in which they are tried: commas may be decimal ones.
constexpr std::array delimiters{Delimiter::semicolon, Delimiter::tab, Delimiter::bar,
                                Delimiter::comma, Delimiter::blanks};

/// The form in which a line is one of numbers, one at least; nothing: it is none.
std::optional<CsvForm> number_form(std::string_view line) {
  for (const Delimiter delimiter : delimiters) {
    for (const bool has_commas : {false, true}) {
      if (has_commas && delimiter == Delimiter::comma) continue;
      CsvForm form{delimiter, has_commas};
      const std::vector<Cell> cells = cells_of(line, delimiter);
      // a lone number is one whatever delimits it
      if (cells.size() < 2 && delimiter != Delimiter::blanks) continue;
      bool has_number = false, is_right = true;
      for (const Cell& cell : cells) {
        const auto value = sample_of(cell.text, has_commas);
        is_right = is_right && value;
        has_number = has_number || (value && std::isfinite(*value));
      }
      if (!is_right || !has_number) continue;
      form.ends_with_delimiter = cells.size() > 2 && cells.back().text.empty();
      return form;
    }
  }
  return std::nullopt;
}

/// "Sample rate: 5 kHz", "fs = 5000": the rate of a line of a header; 0: it says none.
double rate_in(std::string_view line) {
  constexpr std::string_view marks = "#%!/\" \t";
  const auto first = line.find_first_not_of(marks);
  const auto end = line.find_first_of(":=,;\t");
  if (first == std::string_view::npos || end == std::string_view::npos || end <= first) return 0.0;
  const std::string name =
      name_and_unit(trimmed(line.substr(first, end - first)), [](auto&&, auto&&) {
        return false;
      }).name;
  if (!names_rate(name)) return 0.0;
  const std::string value = trimmed(line.substr(end + 1));
  const auto letter = std::min(value.find_first_not_of("+-.0123456789eE"), value.size());
  const auto number = parse_as(value.substr(0, letter), "");
  if (!number) return 0.0;
  return value.find("kHz") != std::string::npos ? 1e3 * *number : *number;
}

/// Names and units of channels from the last lines of a header.
class CsvHeader {
 public:
  CsvHeader(const std::vector<CsvLine>& lines, std::size_t count) {
    for (const CsvLine& line : lines) {
      if (const double found = rate_in(line.text); found > 0.0) rate = found;
      const std::vector<std::string> cells = header_cells(line.text, count);
      if (cells.empty()) continue;
      const bool are_units = !names.empty() && std::all_of(cells.begin(), cells.end(), is_unit);
      if (are_units) {
        for (std::size_t i = 0; i < count; ++i) units[i] = bare_unit(cells[i]);
        continue;
      }
      names.assign(count, "");
      units.assign(count, "");
      for (std::size_t i = 0; i < count; ++i) {
        const NameAndUnit found =
            name_and_unit(cells[i], [](const std::string&, const std::string& unit) {
              return !unit.empty() && is_unit(unit);
            });
        names[i] = found.name;
        units[i] = found.unit;
      }
    }
    names.resize(count);
    units.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (names[i].empty()) names[i] = std::to_string(i + 1);
    }
  }

  std::vector<std::string> names, units;
  double rate = 0.0;  ///< [1/s]; 0: it says none

 private:
  static std::string bare_unit(const std::string& cell) {
    const auto first = cell.find_first_not_of("[( ");
    if (first == std::string::npos) return "";
    return trimmed(cell.substr(first, cell.find_last_not_of("]) ") - first + 1));
  }
  static bool is_unit(const std::string& cell) {
    const std::string unit = bare_unit(cell);
    if (unit.size() < cell.size() || unit.empty() || unit == "-") return true;
    const ChannelUnit known = channel_unit(unit);
    return known.name == "m" || known.name == "V" || parse_as("1 " + unit, "s").value.has_value();
  }
  /// Cells of a line with as many as there are channels, in whatever way they are delimited.
  static std::vector<std::string> header_cells(std::string_view line, std::size_t count) {
    const auto begin = line.find_first_not_of("#%! ");
    if (begin == std::string_view::npos) return {};
    for (const Delimiter delimiter : delimiters) {
      std::vector<Cell> cells = cells_of(line.substr(begin), delimiter);
      if (cells.size() == count + 1 && cells.back().text.empty()) cells.pop_back();
      if (cells.size() != count) continue;
      std::vector<std::string> texts;
      for (const Cell& cell : cells) texts.push_back(cell.text);
      return texts;
    }
    return {};
  }
};

/// The first line of numbers that another one follows, or that is the last.
std::size_t first_of_numbers(const std::vector<CsvLine>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!number_form(lines[i].text)) continue;
    if (i + 1 == lines.size() || number_form(lines[i + 1].text)) return i;
  }
  return lines.size();
}

/// What is said of a table without numbers: the first cell that is none, of the last line.
ModelError no_numbers(const std::string& file, const std::vector<CsvLine>& lines) {
  const std::string message = "has no two lines of numbers, expected a column for each channel";
  if (lines.empty()) return ModelError({file}, "", "is empty: " + message);
  for (const Delimiter delimiter : delimiters) {
    if (delimiter == Delimiter::blanks) continue;
    const std::vector<Cell> cells = cells_of(lines.back().text, delimiter);
    if (cells.size() < 2) continue;
    for (const Cell& cell : cells) {
      if (sample_of(cell.text, delimiter != Delimiter::comma)) continue;
      return ModelError(
          {file, lines.back().number, cell.place}, "",
          fmt::format("{}; {} in the last line is none", message, in_quotes(cell.text)));
    }
  }
  return ModelError({file}, "", message);
}

/// Decimal commas between commas cannot be told from these: there are twice as many columns as names.
void require_other_delimiters(const std::string& file, const CsvLine& header, std::size_t count) {
  const std::size_t names = cells_of(header.text, Delimiter::comma).size();
  if (names < 2 || count != 2 * names) return;
  throw ModelError({file, header.number, 1}, "",
                   fmt::format("names {} columns, and the lines of numbers have {}: decimal commas "
                               "cannot be told from commas between columns, expected decimal "
                               "points, or semicolons between columns",
                               names, count));
}

}  // namespace

RawRecord read_csv_record(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = in_utf8(record_bytes(path), file);
  const std::vector<CsvLine> lines = csv_lines(text);
  const std::size_t first = first_of_numbers(lines);
  if (first == lines.size()) throw no_numbers(file, lines);
  // decimal commas may be in any line: the one with most of them says it
  CsvForm form = *number_form(lines[first].text);
  if (first + 1 < lines.size() && !form.has_decimal_commas) {
    form.has_decimal_commas = number_form(lines[first + 1].text)->has_decimal_commas;
  }
  const std::size_t count = csv_cells(lines[first].text, form).size();
  if (form.delimiter == Delimiter::comma && first > 0) {
    require_other_delimiters(file, lines[first - 1], count);
  }
  const CsvHeader header({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first)},
                         count);
  RawRecord raw{.file = file};
  for (std::size_t i = 0; i < count; ++i) {
    raw.channels.push_back({header.names[i], header.units[i], {}, {file, lines[first].number, 1}});
    raw.channels[i].samples.reserve(lines.size() - first);
  }
  if (header.rate > 0.0) raw.rate = header.rate;
  for (std::size_t i = first; i < lines.size(); ++i) {
    const std::vector<Cell> cells = csv_cells(lines[i].text, form);
    if (cells.size() != count) {
      throw ModelError({file, lines[i].number, 1}, "",
                       fmt::format("found {} columns, expected {} as in line {}", cells.size(),
                                   count, lines[first].number));
    }
    for (std::size_t c = 0; c < count; ++c) {
      const auto value = sample_of(cells[c].text, form.has_decimal_commas);
      if (!value) {
        throw ModelError({file, lines[i].number, cells[c].place}, header.names[c],
                         fmt::format("found {}, expected a number; leave cells of missing samples "
                                     "empty or write nan",
                                     in_quotes(cells[c].text)));
      }
      raw.channels[c].samples.push_back(*value);
    }
  }
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
          const std::string unit = c.unit.empty() ? "" : fmt::format(" [{}]", c.unit);
          out << ',' << csv_quoted(c.name + unit);
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
