#include "libio/text/table.hpp"

#include <algorithm>
#include <string_view>

#include "libio/text/table_text.hpp"
#include "libio/text/terminal.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t gap = 2;         ///< before a column
constexpr std::size_t narrowest = 14;  ///< of a folded column

std::string times(std::string_view sign, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += sign;
  return text;
}

struct ShownColumn {
  std::size_t width = 0;
  bool is_number = true;   ///< its cells stand at the right
  bool has_words = false;  ///< all the same it can be folded: "-3536.4 (368 um), +57.3 (2 um)"
};

/// Lines of a cell in a column of a width; a word that is longer is cut.
std::vector<std::string> cell_lines(const std::string& cell, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& part : folded_words(cell, width)) {
    std::size_t begin = 0, letters = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if ((static_cast<unsigned char>(part[i]) & 0xC0u) == 0x80u || letters++ < width) continue;
      lines.push_back(part.substr(begin, i - begin));
      begin = i;
      letters = 1;
    }
    lines.push_back(part.substr(begin));
  }
  return lines;
}

using Cells = std::vector<std::string>;

std::vector<ShownColumn> columns_of(const Cells& head, const std::vector<Cells>& rows) {
  std::vector<ShownColumn> columns(head.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].width = display_width(head[c]);
    for (const auto& cells : rows) {
      if (c >= cells.size()) continue;
      columns[c].width = std::max(columns[c].width, display_width(cells[c]));
      const bool is_nothing = cells[c].empty() || cells[c] == "·" || cells[c] == "∞";
      const char first = is_nothing ? '-' : cells[c][0];
      if (!(first >= '0' && first <= '9') && first != '-' && first != '+' && first != '.') {
        columns[c].is_number = false;
      }
      const auto blanks = std::count(cells[c].begin(), cells[c].end(), ' ');
      if (blanks > 1) columns[c].has_words = true;  // more than a number and its unit
    }
  }
  return columns;
}

/// Some of the columns, with head and rule.
std::string block(const Cells& head, const std::vector<Cells>& rows,
                  const std::vector<ShownColumn>& columns, const std::vector<std::size_t>& shown) {
  const auto lines = [&](const std::vector<std::string>& cells) {
    std::vector<std::vector<std::string>> folded;
    std::size_t height = 1;
    for (const std::size_t c : shown) {
      folded.push_back(cell_lines(c < cells.size() ? cells[c] : "", columns[c].width));
      height = std::max(height, folded.back().size());
    }
    std::string text;
    for (std::size_t i = 0; i < height; ++i) {
      std::string line;
      for (std::size_t k = 0; k < shown.size(); ++k) {
        const ShownColumn& column = columns[shown[k]];
        const std::string cell = i < folded[k].size() ? folded[k][i] : "";
        const std::string blanks(column.width - std::min(column.width, display_width(cell)), ' ');
        line += std::string(gap, ' ') + (column.is_number ? blanks + cell : cell + blanks);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  };
  std::string out = lines(head);
  std::vector<std::string> rule;
  for (const ShownColumn& column : columns) rule.push_back(times("─", column.width));
  out += lines(rule);
  for (const auto& cells : rows) out += lines(cells);
  return out;
}

}  // namespace

std::string Table::text() const {
  const auto shown = [](Cells cells) {
    for (std::string& cell : cells) cell = shown_line(cell);
    return cells;
  };
  std::vector<Cells> rows;
  for (const Cells& cells : rows_) rows.push_back(shown(cells));
  return table_text(shown(head_), rows, terminal_columns());
}

std::string table_text(const Cells& head, const std::vector<Cells>& rows, std::size_t limit) {
  std::vector<ShownColumn> all = columns_of(head, rows);
  const auto total = [&] {
    std::size_t sum = 0;
    for (const ShownColumn& column : all) sum += gap + column.width;
    return sum;
  };
  // heads of numbers are folded first
  for (std::size_t c = 0; c < all.size() && limit > 0 && total() > limit; ++c) {
    if (!all[c].is_number) continue;
    std::size_t width = 0;
    for (const std::string& word : folded_words(head[c], 1)) {
      width = std::max(width, display_width(word));
    }
    for (const auto& cells : rows) {
      if (c < cells.size()) width = std::max(width, display_width(cells[c]));
    }
    all[c].width = width;
  }
  // then texts, the widest one as long as it is far wider than the others
  while (limit > 0 && total() > limit) {
    ShownColumn* widest = nullptr;
    for (ShownColumn& column : all) {
      if ((column.is_number && !column.has_words) || column.width <= narrowest) continue;
      if (!widest || column.width > widest->width) widest = &column;
    }
    if (!widest) break;
    widest->is_number = false;
    widest->width = std::max(narrowest, widest->width - std::min(total() - limit, widest->width));
  }
  const std::size_t half = std::max<std::size_t>(limit / 2, gap + 1);
  // a word may be longer than a folded column, but no column so wide that none fits beside the
  // first
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::size_t room = limit == 0 ? std::string::npos
                             : c == 0   ? half - gap
                                        : 2 * half - 2 * gap - all[0].width;
    const auto widen = [&](const std::string& cell) {
      for (const std::string& part : folded_words(cell, all[c].width)) {
        all[c].width = std::max(all[c].width, std::min(room, display_width(part)));
      }
    };
    if (total() > limit) all[c].width = std::min(all[c].width, room);
    widen(head[c]);
    for (const auto& cells : rows) {
      if (c < cells.size()) widen(cells[c]);
    }
  }
  std::string out;
  for (std::size_t next = 0; next < all.size();) {
    std::vector<std::size_t> shown;
    std::size_t width = 0;
    if (next > 0) shown.push_back(0), width = gap + all[0].width;
    const std::size_t begin = next;
    while (next < all.size() &&
           (limit == 0 || next == begin || width + gap + all[next].width <= limit)) {
      width += gap + all[next].width;
      shown.push_back(next++);
    }
    out += (begin > 0 ? "\n" : "") + block(head, rows, all, shown);
  }
  return out;
}

}  // namespace whirl::inline io
