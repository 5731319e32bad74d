/// Tables as data loggers write them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/csv_header.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/measured/sample_cell.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view csv_record_head = "# measurement, written by whirl\n";

/// How numbers stand in a table.
struct CsvForm {
  Delimiter delimiter = Delimiter::comma;
  bool ends_with_delimiter = false;  ///< each line, or words follow
  std::size_t columns = 0;
};

/// Words, which are no sample: neither a number, nor what looks like one or stands for one.
bool is_remark(const Cell& cell) {
  return !begins_as_number(cell.text) && !is_missing(cell.text) && !is_no_reading(cell.text);
}

/// Cells of a line of a form, without what is behind a delimiter at its end.
std::vector<Cell> csv_cells(std::string_view line, const CsvForm& form) {
  std::vector<Cell> cells = cells_of(line, form.delimiter);
  const bool has_end = form.ends_with_delimiter && cells.size() == form.columns + 1;
  if (has_end && (cells.back().text.empty() || is_remark(cells.back()))) cells.pop_back();
  return cells;
}

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
      is_right = is_right && value;
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

/// Takes lines of words off the end, which are notes below a table.
void drop_notes(std::vector<CsvLine>& lines, Delimiter delimiter) {
  const auto is_note = [&](const CsvLine& line) {
    bool has_words = false;
    for (const Cell& cell : cells_of(line.text, delimiter)) {
      if (!cell.text.empty() && !is_remark(cell)) return false;
      has_words = has_words || !cell.text.empty();
    }
    return has_words;
  };
  while (!lines.empty() && is_note(lines.back())) lines.pop_back();
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
      if (sample_of(cell.text)) continue;
      return ModelError(
          {file, lines.back().number, cell.place}, "",
          fmt::format("{}; {} in the last line is none", message, in_quotes(cell.text)));
    }
  }
  return ModelError({file}, "", message);
}

/// Whether a line names columns: none of its cells is a number, and it says no rate.
bool names_columns(std::string_view line, const std::vector<Cell>& cells) {
  return csv_rate_in(line) == 0.0 && std::none_of(cells.begin(), cells.end(), [](const Cell& c) {
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

/// The samples of a table, whose numbers say together what their commas and points are.
class CsvSamples {
 public:
  CsvSamples(RawRecord& raw, const CsvForm& form, bool has_names)
      : raw_(raw), form_(form), marks_{form.delimiter} {
    may_be_decimals_ =
        form.delimiter == Delimiter::comma && !has_names && raw.channels.size() % 2 == 0;
  }

  void add(const CsvLine& line, int first_line) {
    const std::vector<Cell> cells = csv_cells(line.text, form_);
    const std::size_t count = raw_.channels.size();
    if (cells.size() != count) {
      throw ModelError({raw_.file, line.number, 1}, "",
                       fmt::format("found {} columns, expected {} as in line {}", cells.size(),
                                   count, first_line));
    }
    for (std::size_t c = 0; c < count; ++c) add(cells[c], line, c);
  }

  void tell_no_readings() { no_readings_.tell(raw_); }

  /// @throws ModelError  for a comma or point that may be that of thousands or of decimals
  void require_one_reading() {
    for (const Doubt& doubt : {comma_, point_}) {
      if (doubt.cell.empty()) continue;
      const auto number = plain_number(doubt.cell, marks_);
      if (!number) throw ModelError(doubt.where, doubt.channel, number.problem);
    }
    if (!point_.cell.empty() && !marks_.has_decimal_points && form_.delimiter != Delimiter::comma) {
      raw_.notes.push_back(fmt::format(
          "points are taken as decimal ones ({}), and no number shows that they are none of "
          "thousands",
          point_.cell));
    }
    if (may_be_decimals_) {
      throw ModelError(
          raw_.channels.front().where, "",
          fmt::format("the commas may stand between {} columns of whole numbers, or be decimal "
                      "ones of {}, and no line names the columns: write such a line, or semicolons "
                      "between columns",
                      raw_.channels.size(), raw_.channels.size() / 2));
    }
  }

 private:
  /// The first number whose comma, or point, may be that of thousands or of decimals.
  struct Doubt {
    std::string cell, channel;
    Where where{};
  };

  void add(const Cell& cell, const CsvLine& line, std::size_t c) {
    const RawChannel& channel = raw_.channels[c];
    const auto value = sample_of(cell.text);
    if (!value) {
      throw ModelError(
          {raw_.file, line.number, cell.place}, channel.name,
          fmt::format("found {}, expected a number{}; leave cells of missing samples "
                      "empty or write nan",
                      in_quotes(cell.text),
                      begins_as_number(cell.text) ? " without marks of thousands" : ""));
    }
    raw_.channels[c].samples.push_back(*value);
    if (std::isnan(*value) && is_no_reading(cell.text)) {
      no_readings_.add(cell.text, c, {raw_.file, line.number, cell.place});
    }
    if (const char mark = marks_.add(cell.text); mark != '\0') {
      Doubt& first = mark == ',' ? comma_ : point_;
      if (first.cell.empty()) {
        first = {cell.text, channel.name, {raw_.file, line.number, cell.place}};
      }
    }
    if (may_be_decimals_) {
      const std::string_view digits =
          std::string_view(cell.text).substr(c % 2 == 0 && cell.text.starts_with('-') ? 1 : 0);
      may_be_decimals_ =
          !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
    }
  }

  RawRecord& raw_;
  CsvForm form_;
  NumberMarks marks_;
  NoReadings no_readings_;
  Doubt comma_, point_;
  bool may_be_decimals_ = false;  ///< commas: nothing shows that they stand between columns
};

}  // namespace

RawRecord read_csv_record(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto text = in_utf8(record_bytes(path));
  if (!text) throw ModelError({file}, "", text.problem);
  return read_csv_text(*text, file);
}

RawRecord read_csv_text(const std::string& text, const std::string& file) {
  std::vector<CsvLine> lines = csv_lines(text);
  const auto body = body_of(lines);
  if (!body) throw no_numbers(file, lines);
  auto [form, first] = *body;
  drop_notes(lines, form.delimiter);
  take_last_column(form, lines, first);
  const CsvHeader header =
      csv_header({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first)}, form.columns,
                 form.ends_with_delimiter);
  if (!header.has_names && first > 0 && form.delimiter == Delimiter::comma) {
    require_other_delimiters(file, lines[first - 1], csv_cells(lines[first].text, form));
  }
  RawRecord raw{.file = file};
  for (std::size_t i = 0; i < form.columns; ++i) {
    raw.channels.push_back({header.names[i], header.units[i], {}, {file, lines[first].number, 1}});
    raw.channels[i].samples.reserve(lines.size() - first);
  }
  if (header.rate > 0.0) raw.rate = header.rate;
  CsvSamples samples(raw, form, header.has_names);
  for (std::size_t i = first; i < lines.size(); ++i) samples.add(lines[i], lines[first].number);
  samples.require_one_reading();
  samples.tell_no_readings();
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
