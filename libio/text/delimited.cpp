#include "libio/text/delimited.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "libio/text/line_kinds.hpp"

namespace whirl::inline io {

namespace {

bool is_numeral(char c) {
  return c >= '0' && c <= '9';
}

/// Characters, not bytes, of a text.
int characters_in(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
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
    case Delimiter::cell:
      return c == cell_mark;
    case Delimiter::comma:
      return c == ',' || c == ';';
    case Delimiter::semicolon:
      return c == ';';
    case Delimiter::tab:
      return c == '\t';
    case Delimiter::bar:
      return c == '|';
    case Delimiter::blanks:
      return c == ' ' || c == '\t';
  }
  return false;
}

/// Bytes of the mark that a comment begins with; 0: it is none.
std::size_t comment_mark(std::string_view line) {
  if (line.find(cell_mark) != std::string_view::npos) return 0;  // a sheet has no comments
  const std::string text = trimmed(line);
  if (text.empty()) return 0;
  const auto begin = line.find_first_not_of(" \t\r\"");
  if (text.starts_with("//")) return begin + 2;
  const char sign = text[0];
  if (sign != '#' && sign != '!' && sign != '%') return 0;
  return std::min(line.find_first_not_of(sign, begin), line.size());
}

/// A comment as a line of names. "#;length;od" has a column "#", "# length;od" has not.
TableLine as_names(const TableLine& comment, std::size_t mark) {
  const std::string_view line = comment.text;
  const auto next = line.find_first_not_of(" \"", mark);
  const bool is_name = line[0] == '#' && next != std::string_view::npos &&
                       std::string_view(";,\t").find(line[next]) != std::string_view::npos;
  if (is_name) return comment;
  return {comment.number, std::string(line.substr(mark)), characters_in(line.substr(0, mark))};
}

bool has_number(const std::string& line) {
  const std::vector<Cell> cells = cells_of(line, delimiter_of(line));
  return std::any_of(cells.begin(), cells.end(),
                     [](const Cell& cell) { return begins_as_number(cell.text); });
}

/// Where the names of columns are among the first lines: in the one that names most, two or more.
std::size_t line_of_names(const std::vector<TableLine>& lines,
                          const std::function<std::size_t(const std::string&)>& known_names) {
  std::size_t at = 0, most = 1;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (begins_as_number(trimmed(lines[i].text)) && is_row_of_numbers(lines[i].text)) break;
    const std::size_t known = known_names(lines[i].text);
    if (known <= most) continue;
    at = i;
    most = known;
  }
  return at;
}

/// Cells of a line of a sheet: the place of each is the number of its column.
std::vector<Cell> cells_of_sheet(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(cell_mark, start), line.size());
    cells.push_back({trimmed(line.substr(start, end - start)), static_cast<int>(cells.size()) + 1});
    start = end + 1;
  }
  return cells;
}

/// Whether a line repeats the line of names, as prints do on every page.
bool repeats(const std::vector<Cell>& names, const std::vector<Cell>& cells) {
  return std::equal(names.begin(), names.end(), cells.begin(), cells.end(),
                    [](const Cell& a, const Cell& b) { return a.text == b.text; });
}

/// The one comma or point of a number.
struct NumberMark {
  char sign = ',';
  std::string_view before, after;  ///< digits around it, with the sign of the number
  bool may_be_thousands = false;   ///< three digits behind it, up to three before
};

std::optional<NumberMark> mark_of(std::string_view cell) {
  const std::string_view numeral = cell.substr(0, numeral_end(cell));
  const auto at = numeral.find_first_of(",.");
  if (at == std::string_view::npos) return std::nullopt;
  if (numeral.find_first_of(",.", at + 1) != std::string_view::npos) return std::nullopt;
  std::size_t end = at + 1;
  while (end < numeral.size() && is_numeral(numeral[end])) ++end;
  NumberMark mark{.sign = numeral[at],
                  .before = numeral.substr(0, at),
                  .after = numeral.substr(at + 1, end - at - 1)};
  const bool is_signed = !mark.before.empty() && !is_numeral(mark.before[0]);
  const std::string_view digits = mark.before.substr(is_signed ? 1 : 0);
  mark.may_be_thousands = mark.after.size() == 3 && end == numeral.size() && !digits.empty() &&
                          digits.size() <= 3 && digits[0] != '0' &&
                          std::all_of(digits.begin(), digits.end(), is_numeral);
  return mark;
}

/// What is wrong with a comma or point that may be either: what would be right.
std::string doubt_of(std::string_view cell, const NumberMark& mark, const NumberMarks& all) {
  std::string decimals(mark.after);
  while (decimals.size() > 1 && decimals.back() == '0') decimals.pop_back();
  const bool is_comma = mark.sign == ',';
  const char* others = "no other number of this table shows which";
  if (all.has_decimal_commas && all.has_decimal_points) {
    others = "other numbers of this table have decimal commas and points";
  } else if (all.has_decimal_commas || all.has_decimal_points) {
    others = is_comma ? "other numbers of this table have decimal points"
                      : "other numbers of this table have decimal commas";
  }
  return fmt::format(
      "the {} in {} may be that of thousands or of decimals, and {}; write {}{} or {}{}{}",
      is_comma ? "comma" : "point", in_quotes(cell), others, mark.before, mark.after, mark.before,
      is_comma ? '.' : ',', decimals);
}

/// Where the brackets begin that a unit stands in: those at the end, "shaft (DE) [um]", else the
/// first.
std::size_t unit_bracket(std::string_view cell) {
  const bool is_round = cell.ends_with(')'), is_square = cell.ends_with(']');
  int depth = 0;
  for (std::size_t i = cell.size(); (is_round || is_square) && i-- > 0;) {
    if (cell[i] == (is_round ? ')' : ']')) ++depth;
    if (cell[i] == (is_round ? '(' : '[') && --depth == 0) return i;
  }
  return cell.find_first_of("[(");
}

/// A message without the numbers, which differ from row to row; digits in words are none.
std::string cause_of(const Problem& problem) {
  std::string cause = problem.key + '\n';
  bool is_word = false;
  for (const char c : problem.message) {
    is_word = std::isalpha(static_cast<unsigned char>(c)) != 0 || (is_word && is_numeral(c));
    if (is_word || std::string_view("0123456789+-.,").find(c) == std::string_view::npos) cause += c;
  }
  return cause;
}

}  // namespace

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::string plain_name(std::string_view name) {
  // letters of Latin-1 from 0xC0 on; in UTF-8 they are 0xC3 and a byte from 0x80 on
  static constexpr std::string_view letters =
      "aaaaaaaceeeeiiiidnooooo*ouuuuytsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (std::string_view(" \t_-.").find(c) != std::string_view::npos) continue;
    const unsigned char next = i + 1 < name.size() ? static_cast<unsigned char>(name[i + 1]) : 0;
    if (c == '\xC3' && next >= 0x80 && next < 0xC0) {
      plain += letters[next - 0x80u];
      if (next == 0x9F) plain += 's';  // sharp s
      ++i;
      continue;
    }
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

NameAndUnit name_and_unit(
    const std::string& cell,
    const std::function<bool(const std::string&, const std::string&)>& is_known) {
  const auto bracket = unit_bracket(cell);
  if (bracket != std::string::npos) {
    const auto end = cell.find_last_of("])");
    const auto from = bracket + 1;
    const auto size = end == std::string::npos || end < from ? std::string::npos : end - from;
    return {trimmed(std::string_view(cell).substr(0, bracket)),
            trimmed(std::string_view(cell).substr(from, size)), true};
  }
  if (is_known(cell, "")) return {cell, "", false};
  for (const std::string_view between : {" / ", " in ", ",", " ", "_"}) {
    const auto at = cell.find(between);
    if (at == std::string::npos) continue;
    const std::string name = cell.substr(0, at), unit = trimmed(cell.substr(at + between.size()));
    if (is_known(name, unit)) return {name, unit, true};
  }
  return {cell, "", false};
}

std::vector<TableLine> table_lines(
    const std::string& text, const std::function<std::size_t(const std::string&)>& known_names) {
  std::vector<TableLine> lines;
  TableLine comment;  // right above
  std::istringstream stream(text);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets begin so
    if (line.find_first_not_of(" \t\r\",;\x1F") == std::string::npos) continue;
    if (comment_mark(line) > 0) {
      comment = {number, line};
      continue;
    }
    if (lines.empty() && comment.number > 0 && known_names(line) == 0 && has_number(line)) {
      const TableLine names = as_names(comment, comment_mark(comment.text));
      if (known_names(names.text) > 1) lines.push_back(names);
    }
    lines.push_back({number, line});
  }
  lines.erase(lines.begin(),
              lines.begin() + static_cast<std::ptrdiff_t>(line_of_names(lines, known_names)));
  return lines;
}

std::vector<TableRow> table_rows(const std::vector<TableLine>& lines, Delimiter delimiter,
                                 std::size_t columns) {
  std::vector<TableRow> rows;
  const std::vector<Cell> names =
      lines.empty() ? std::vector<Cell>() : cells_of(lines[0].text, delimiter);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<Cell> cells = cells_of(lines[i].text, delimiter);
    if (repeats(names, cells)) continue;
    // a sheet's lines end with their last cell
    if (delimiter == Delimiter::cell && cells.size() < columns) cells.resize(columns);
    while (cells.size() > columns && !begins_as_number(cells.back().text)) cells.pop_back();
    rows.push_back({&lines[i], std::move(cells)});
  }
  const auto is_below = [&] {
    const std::vector<Cell>& last = rows.back().cells;
    if (is_note(last, columns, delimiter) || is_total(last, columns)) return true;
    return std::any_of(rows.rbegin() + 1, rows.rend(),
                       [&](const TableRow& row) { return is_statistic(last, row.cells); });
  };
  while (!rows.empty() && is_below()) rows.pop_back();
  return rows;
}

Delimiter delimiter_of(std::string_view line) {
  if (line.find(cell_mark) != std::string_view::npos) return Delimiter::cell;
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

std::vector<Cell> cells_of(std::string_view line, Delimiter delimiter) {
  if (delimiter == Delimiter::cell) return cells_of_sheet(line);
  std::vector<Cell> cells;
  std::size_t start = 0, counted = 0;
  int place = 1;  // of the character at `counted`
  const auto add = [&](std::size_t end) {
    const std::string_view part = line.substr(start, end - start);
    const auto first = part.find_first_not_of(" \t\r\"");
    const bool is_empty = first == std::string_view::npos;
    if (!is_empty || delimiter != Delimiter::blanks) {
      const std::size_t begin = is_empty ? start : start + first;
      place += characters_in(line.substr(counted, begin - counted));
      counted = begin;
      cells.push_back({trimmed(part), place});
    }
    start = end + 1;
  };
  for_each_outside(line, [&](char c, std::size_t i) {
    if (delimits(c, delimiter)) add(i);
  });
  if (start <= line.size()) add(line.size());
  return cells;
}

void report_count(const std::vector<Cell>& cells, std::size_t columns, Delimiter delimiter,
                  const ReportProblem& report) {
  const bool has_more = cells.size() > columns;
  const bool may_be_decimals = has_more && delimiter == Delimiter::comma;
  const int place =
      has_more ? cells[columns].place : cells.back().place + characters_in(cells.back().text);
  report(place, "",
         fmt::format("found {} columns, expected {} as in the first line{}", cells.size(), columns,
                     may_be_decimals ? "; numbers with commas need semicolons between them" : ""));
}

bool begins_as_number(std::string_view text) {
  static constexpr std::string_view signs = "+-.", numerals = "0123456789";
  const auto digit = text.find_first_not_of(signs);
  return digit != std::string_view::npos && numerals.find(text[digit]) != std::string_view::npos;
}

bool is_line_of_units(const std::vector<Cell>& cells) {
  bool has_any = false;
  for (const auto& [text, place] : cells) {
    if (text.empty() || text == "-") continue;
    const bool is_one_over = text.starts_with("1/");
    const bool is_bracketed = text.front() == '[' || text.front() == '(';
    const char first = is_bracketed ? 'x' : text.front();
    const bool is_number = std::string_view("+-.0123456789").find(first) != std::string_view::npos;
    if (is_number && !is_one_over) return false;
    // what is no number and no unit, such as nan, is reported as a value
    static constexpr std::string_view never[] = {"nan", "inf", "infinity"};
    if (std::find(std::begin(never), std::end(never), plain_name(text)) != std::end(never)) {
      return false;
    }
    has_any = true;
  }
  return has_any;
}

char NumberMarks::add(std::string_view cell) {
  const auto mark = mark_of(cell);
  if (!mark) return '\0';
  if (mark->may_be_thousands) return mark->sign;
  (mark->sign == ',' ? has_decimal_commas : has_decimal_points) = true;
  return '\0';
}

Parsed<std::string> plain_number(std::string_view cell, const NumberMarks& marks) {
  using Result = Parsed<std::string>;
  std::string text(cell);
  const auto end = numeral_end(text);
  for (std::size_t i = 1; i + 1 < end; ++i) {
    const bool is_exponent = (text[i] == 'd' || text[i] == 'D') &&
                             (is_numeral(text[i - 1]) || text[i - 1] == '.') &&
                             (is_numeral(text[i + 1]) || text[i + 1] == '+' || text[i + 1] == '-');
    if (is_exponent) text[i] = 'E';
  }
  const auto mark = mark_of(cell);
  if (!mark) return text;
  const bool is_comma = mark->sign == ',';
  const bool has_clear_commas = marks.has_decimal_commas && !marks.has_decimal_points;
  if (mark->may_be_thousands && is_comma != has_clear_commas) {
    return Result::failed(doubt_of(cell, *mark, marks));
  }
  if (is_comma && marks.delimiter != Delimiter::comma) text[text.find(',')] = '.';
  return text;
}

void tell_once(std::vector<Problem>& problems, std::size_t first) {
  struct Told {
    std::size_t at = 0;  ///< of the one that stays
    std::set<int> lines;
  };
  std::map<std::string, Told> told;
  std::vector<Problem> kept(problems.begin(),
                            problems.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = first; i < problems.size(); ++i) {
    const auto [found, is_new] = told.try_emplace(cause_of(problems[i]), Told{kept.size(), {}});
    found->second.lines.insert(problems[i].where.line);
    if (is_new) kept.push_back(problems[i]);
  }
  for (const auto& [cause, all] : told) {
    const std::size_t more = all.lines.size() - 1;
    if (more == 0) continue;
    kept[all.at].message += fmt::format("; and {} more row{}", more, more == 1 ? "" : "s");
  }
  problems = std::move(kept);
}

}  // namespace whirl::inline io
