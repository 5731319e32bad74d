#include "libio/table.hpp"

#include <algorithm>

namespace whirl {

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;  // not a continuation byte
  }));
}

std::string Table::text() const {
  const std::size_t columns = head_.size();
  std::vector<std::size_t> width(columns);
  std::vector<bool> is_number(columns, true);
  for (std::size_t c = 0; c < columns; ++c) {
    width[c] = display_width(head_[c]);
    for (const auto& cells : rows_) {
      if (c >= cells.size()) continue;
      width[c] = std::max(width[c], display_width(cells[c]));
      const bool is_nothing = cells[c].empty() || cells[c] == "·";
      const char first = is_nothing ? '-' : cells[c][0];
      if (!(first >= '0' && first <= '9') && first != '-' && first != '+' && first != '.') {
        is_number[c] = false;
      }
    }
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string out;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string cell = c < cells.size() ? cells[c] : "";
      const std::string blanks(width[c] - display_width(cell), ' ');
      out += "  " + (is_number[c] ? blanks + cell : cell + blanks);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    return out + "\n";
  };
  std::string out = line(head_);
  std::vector<std::string> rule;
  for (std::size_t c = 0; c < columns; ++c) {
    std::string dashes;
    for (std::size_t i = 0; i < width[c]; ++i) dashes += "─";
    rule.push_back(dashes);
  }
  out += line(rule);
  for (const auto& cells : rows_) out += line(cells);
  return out;
}

}  // namespace whirl
