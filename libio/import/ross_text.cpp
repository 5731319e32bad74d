#include "libio/import/ross_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace whirl::inline io {

std::string shown_number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t last = text.find_last_not_of('0');
  const std::size_t first = text.front() == '-' ? 1 : 0;
  constexpr std::size_t long_tail = 5;
  const bool is_whole = text.find_first_of(".e") == std::string::npos;
  if (!is_whole || last == std::string::npos || text.size() - last <= long_tail) return text;
  const std::size_t exponent = text.size() - first - 1;
  std::string digits = text.substr(first, last + 1 - first);
  if (digits.size() > 1) digits.insert(1, ".");
  return fmt::format("{}{}e{}", first == 1 ? "-" : "", digits, exponent);
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  }
  return text;
}

std::string shown_matrix(double xx, double xy, double yx, double yy) {
  if (xx == yy && xx >= 0.0 && xy == 0.0 && yx == 0.0) return shown_number(xx);
  std::string text = fmt::format("{{ xx = {}, yy = {}", shown_number(xx), shown_number(yy));
  if (xy != 0.0) text += fmt::format(", xy = {}", shown_number(xy));
  if (yx != 0.0) text += fmt::format(", yx = {}", shown_number(yx));
  return text + " }";
}

std::string shown_pair(const std::array<double, 2>& ends) {
  if (ends[0] == ends[1]) return fmt::format("{}", ends[0]);
  return fmt::format("[{}, {}]", ends[0], ends[1]);
}

std::string file_part(const std::string& name) {
  std::string part;
  for (const char c : name) {
    part += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
  }
  return part;
}

std::string table_of(const RossBearing& b) {
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < ross_coefficients.size(); ++k) {
    const bool is_used = std::any_of(b.rows.begin(), b.rows.end(),
                                     [&](const auto& row) { return row.values[k] != 0.0; });
    if (is_used || k == 0) used.push_back(k);
  }
  std::vector<std::string> head;
  if (b.has_speed) head.emplace_back("speed [rad/s]");
  if (b.has_whirl) head.emplace_back("whirl [rad/s]");
  constexpr const char* units[] = {"N/m", "N.s/m", "kg"};
  for (const std::size_t k : used) {
    head.push_back(fmt::format("{} [{}]", ross_coefficients[k], units[k / 4]));
  }
  std::string csv = fmt::format("{}\n", fmt::join(head, ", "));
  for (const RossBearing::Row& row : b.rows) {
    std::vector<double> cells;
    if (b.has_speed) cells.push_back(row.speed);
    if (b.has_whirl) cells.push_back(row.whirl);
    for (const std::size_t k : used) cells.push_back(row.values[k]);
    csv += fmt::format("{}\n", fmt::join(cells, ", "));
  }
  return csv;
}

}  // namespace whirl::inline io
