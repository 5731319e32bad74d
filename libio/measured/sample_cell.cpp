#include "libio/measured/sample_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

/// Letters and signs of a cell, in lower case: "Over Range" and "OVER_RANGE" are the same.
std::string word_of(std::string_view cell) {
  std::string word = lower_case(cell);
  std::erase_if(word, [](char c) { return c == ' ' || c == '_' || c == '\t'; });
  return word;
}

template <std::size_t N>
bool is_one_of_words(std::string_view cell, const std::array<std::string_view, N>& words) {
  constexpr std::size_t longest = 24;  // with blanks
  if (cell.size() > longest) return false;
  return std::find(words.begin(), words.end(), word_of(cell)) != words.end();
}

}  // namespace

bool is_missing(std::string_view cell) {
  static constexpr std::array<std::string_view, 8> marks{"",    "nan",  "-nan", "na",
                                                         "n/a", "null", "-",    "--"};
  return is_one_of_words(cell, marks);
}

bool is_no_reading(std::string_view cell) {
  static constexpr std::array<std::string_view, 25> marks{
      "overrange", "over-range", "overflow", "overload",   "over",        "ovr",       "ovrflw",
      "ovl",       "ol",         "o.l.",     "underrange", "under-range", "underflow", "+over",
      "-over",     "#n/a",       "#na",      "#nan",       "#num!",       "#div/0!",   "#value!",
      "inf",       "+inf",       "-inf",     "infinity"};
  return is_one_of_words(cell, marks);
}

std::optional<double> sample_of(std::string_view cell) {
  std::string_view text = cell;
  std::string with_point;
  if (text.find(',') != std::string_view::npos) {
    with_point = text;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    text = with_point;
  }
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && stop == text.data() + text.size()) {
    return std::isfinite(value) ? value : nan;
  }
  if (is_missing(cell) || is_no_reading(cell)) return nan;
  return std::nullopt;
}

std::optional<double> finite_sample_of(std::string_view cell) {
  const auto value = sample_of(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

void NoReadings::add(std::string_view cell, std::size_t channel, const Where& where) {
  if (found_.size() <= channel) found_.resize(channel + 1);
  Found& found = found_[channel];
  if (found.count++ > 0) return;
  found.cell = std::string(cell);
  found.where = where;
}

void NoReadings::tell(RawRecord& raw) const {
  for (std::size_t c = 0; c < found_.size(); ++c) {
    if (found_[c].count == 0) continue;
    const std::string& name = raw.channels[c].name;
    const std::string which = name.empty() ? std::to_string(c + 1) : in_quotes(name);
    raw.notes.push_back(fmt::format(
        "channel {}: {} say {} instead of a number, the first one in line {}: these samples are "
        "taken as missing",
        which, found_[c].count == 1 ? "1 cell" : fmt::format("{} cells", found_[c].count),
        in_quotes(found_[c].cell), found_[c].where.line));
  }
}

}  // namespace whirl::inline io
