#include "libio/measured/lvm_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "libbase/error.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view lvm_mark = "LabVIEW Measurement";
constexpr std::string_view end_of_header = "***End_of_Header***";
constexpr std::string_view special_begin = "***Start_Special***", special_end = "***End_Special***";

/// What a line of a segment's header says, with a value in the column of each channel.
struct LvmTag {
  std::string_view name;
  std::string_view LvmChannel::*member = nullptr;  ///< nothing: it says nothing of the samples
};

constexpr std::array<LvmTag, 18> segment_tags{{
    {"Channels"},
    {"Samples", &LvmChannel::samples},
    {"Date", &LvmChannel::date},
    {"Time", &LvmChannel::time},
    {"Y_Unit_Label", &LvmChannel::unit},
    {"X_Dimension", &LvmChannel::dimension},
    {"X_Unit_Label", &LvmChannel::x_unit},
    {"X0", &LvmChannel::x0},
    {"Delta_X", &LvmChannel::delta},
    {"Y_Dimension"},
    {"Notes"},
    {"Test_Name"},
    {"Test_Numbers"},
    {"Test_Series"},
    {"UUT_M/N"},
    {"UUT_Name"},
    {"UUT_S/N"},
    {"Comment"},
}};

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Goes through the lines of a file.
class LvmReader {
 public:
  LvmReader(std::string_view text, const std::string& file) : rest_(text), file_(file) { next(); }

  LvmFile read() {
    read_form();
    while (has_line_) {
      skip_specials();
      if (!has_line_) break;
      if (first_cell().empty()) {
        next();
      } else if (first_cell() == lvm_mark) {  // a file that was written behind this one
        read_form();
      } else {
        read_segment();
      }
    }
    return std::move(found_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& why) const {
    throw ModelError({file_, line, line > 0 ? 1 : 0}, "", why);
  }

  void next() {
    has_line_ = !rest_.empty();
    const auto end = std::min(rest_.find('\n'), rest_.size());
    line_ = {line_.number + 1, rest_.substr(0, end)};
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line_.text.ends_with('\r')) line_.text.remove_suffix(1);
  }

  std::string_view first_cell() const {
    return without_blanks(line_.text.substr(0, line_.text.find(found_.form.separator)));
  }

  void skip_specials() {
    while (has_line_ && first_cell() == special_begin) {
      const int begin = line_.number;
      while (has_line_ && first_cell() != special_end) next();
      if (!has_line_) fail(begin, "a special block begins, and no ***End_Special*** ends it");
      next();
    }
  }

  /// The separator stands behind its own name: "Separator<Tab>Tab".
  void take_separator() {
    const std::string_view text = line_.text;
    const std::string_view name = "Separator";
    if (!text.starts_with(name) || text.size() == name.size()) return;
    const char written = text[name.size()];
    const std::string_view word = without_blanks(text.substr(name.size() + 1));
    if (word.starts_with("Tab")) found_.form.separator = '\t';
    if (word.starts_with("Comma")) found_.form.separator = ',';
    if (word.starts_with("Semicolon")) found_.form.separator = ';';
    if (word.empty() || word.front() == written) found_.form.separator = written;
  }

  void read_form() {
    const int begin = line_.number;
    for (; has_line_ && !line_.text.starts_with(end_of_header); next()) {
      take_separator();
      const auto cells = lvm_cells(line_.text, found_.form.separator);
      if (cells.size() < 2) continue;
      const std::string_view value = cells[1];
      if (cells[0] == "Decimal_Separator" && value.size() == 1) found_.form.decimal = value.front();
      // where commas separate, that of decimals may be written behind one
      if (line_.text == "Decimal_Separator,,") found_.form.decimal = ',';
      if (cells[0] == "X_Columns") take_x_columns(value);
    }
    if (!has_line_) fail(begin, "the header does not end: no ***End_of_Header*** follows");
    if (found_.form.separator == found_.form.decimal) {
      fail(begin, fmt::format("\"{}\" separates columns and decimals, which cannot be told apart: "
                              "expected another Separator, such as Tab",
                              found_.form.decimal));
    }
    next();
  }

  void take_x_columns(std::string_view value) {
    using X = LvmForm::XColumns;
    if (value == "No") {
      found_.form.x = X::none;
    } else if (value == "One") {
      found_.form.x = X::one;
    } else if (value == "Multi") {
      found_.form.x = X::each;
    } else {
      fail(line_.number, fmt::format("X_Columns is \"{}\", expected No, One or Multi", value));
    }
  }

  void read_segment() {
    LvmSegment segment{.line = line_.number};
    std::vector<CsvLine> header;
    for (; has_line_ && !line_.text.starts_with(end_of_header); next()) {
      skip_specials();
      if (has_line_) header.push_back(line_);
    }
    if (!has_line_) {
      fail(segment.line, "the header of a segment does not end: no ***End_of_Header*** follows");
    }
    next();
    if (!has_line_) fail(segment.line, "the header of a segment is the end: no samples follow");
    take_names(segment);
    for (const CsvLine& line : header) take_line(segment, line);
    while (has_line_ && !begins_other()) {
      segment.rows.push_back(line_);
      next();
    }
    while (!segment.rows.empty() && without_blanks(segment.rows.back().text).empty()) {
      segment.rows.pop_back();
    }
    found_.segments.push_back(std::move(segment));
  }

  /// Whether a line below samples begins something else.
  bool begins_other() const {
    const std::string_view cell = first_cell();
    return cell == lvm_mark || cell == special_begin ||
           std::any_of(segment_tags.begin(), segment_tags.end(),
                       [&](const LvmTag& tag) { return tag.name == cell; });
  }

  /// "X_Value, a, b, Comment", or with times of each "X_Value, a, X_Value, b, Comment".
  void take_names(LvmSegment& segment) {
    const auto cells = lvm_cells(line_.text, found_.form.separator);
    if (cells.empty() || cells[0] != "X_Value") {
      fail(line_.number, fmt::format("found \"{}\", expected the names of the columns, X_Value "
                                     "first",
                                     cells.empty() ? "" : cells[0]));
    }
    const bool has_each = found_.form.x == LvmForm::XColumns::each;
    std::size_t count = cells.size();
    while (count > 0 && (cells[count - 1] == "Comment" || cells[count - 1].empty())) --count;
    for (std::size_t c = 1; c < count; c += has_each ? 2 : 1) {
      if (has_each && cells[c - 1] != "X_Value") {
        fail(line_.number, fmt::format("column {} is \"{}\", expected X_Value, as X_Columns is "
                                       "Multi",
                                       c, cells[c - 1]));
      }
      segment.channels.push_back({.name = cells[c], .column = c, .x_column = has_each ? c - 1 : 0});
    }
    if (segment.channels.empty()) fail(line_.number, "names no channel beside X_Value");
    next();
  }

  void take_line(LvmSegment& segment, const CsvLine& line) {
    const auto cells = lvm_cells(line.text, found_.form.separator);
    if (cells.empty()) return;
    if (cells[0] == "Channels" && cells.size() > 1 &&
        cells[1] != std::to_string(segment.channels.size())) {
      fail(line.number, fmt::format("says {} channels, and the line of names has {}", cells[1],
                                    segment.channels.size()));
    }
    const auto tag = std::find_if(segment_tags.begin(), segment_tags.end(),
                                  [&](const LvmTag& t) { return t.name == cells[0]; });
    if (tag == segment_tags.end() || !tag->member) return;
    std::vector<std::string_view> filled;
    for (std::size_t c = 1; c < cells.size(); ++c) {
      if (!cells[c].empty()) filled.push_back(cells[c]);
    }
    const bool has_all = filled.size() == segment.channels.size();
    for (std::size_t k = 0; k < segment.channels.size(); ++k) {
      LvmChannel& channel = segment.channels[k];
      if (!has_all && channel.column >= cells.size()) break;
      channel.*tag->member = has_all ? filled[k] : cells[channel.column];
    }
  }

  std::string_view rest_;
  const std::string& file_;
  CsvLine line_{};
  bool has_line_ = false;
  LvmFile found_;
};

}  // namespace

bool is_lvm(std::string_view text) {
  return text.starts_with(lvm_mark);
}

std::vector<std::string_view> lvm_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (true) {
    const auto end = line.find(separator);
    cells.push_back(without_blanks(line.substr(0, end)));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

LvmFile lvm_file(std::string_view text, const std::string& file) {
  return LvmReader(text, file).read();
}

}  // namespace whirl::inline io
