#include "libio/text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace whirl::inline io {

namespace {

constexpr int one_edit = 2;
constexpr int case_edit = 1;
constexpr int farthest = 6;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

int exchange(char a, char b) {
  if (a == b) return 0;
  return lower(a) == lower(b) ? case_edit : one_edit;
}

/// Edit distance with swaps of neighbors (optimal string alignment), row by row.
int distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = one_edit * static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = one_edit * static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + one_edit, row[j - 1] + one_edit,
                         above[j - 1] + exchange(a[i - 1], b[j - 1])});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before[j - 2] + one_edit);
    }
  }
  return row[b.size()];
}

/// Whether a word is the first or the last part of a name: "diameter" of "outer_diameter".
bool is_part(std::string_view word, std::string_view name) {
  if (word.empty() || name.size() <= word.size()) return false;
  const std::size_t rest = name.size() - word.size();
  return (name.ends_with(word) && name[rest - 1] == '_') ||
         (name.starts_with(word) && name[word.size()] == '_');
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known) {
  const int size = static_cast<int>(std::min<std::size_t>(word.size(), 1000));
  int best = std::min(size, farthest) + 1;
  std::optional<std::string> found;
  for (const std::string& candidate : known) {
    // the lengths alone may say that it is too far; this also keeps huge words cheap
    const int longer = std::abs(static_cast<int>(candidate.size()) - size);
    if (one_edit * longer >= best) continue;
    if (const int d = distance(word, candidate); d < best) {
      best = d;
      found = candidate;
    }
  }
  if (found) return found;
  for (const std::string& candidate : known) {
    if (is_part(word, candidate)) return candidate;
  }
  return std::nullopt;
}

std::optional<std::string> unknown_option(std::span<const std::string> words,
                                          std::span<const std::string> known) {
  for (const std::string& given : words) {
    const std::string word = given.substr(0, given.find('='));
    if (!word.starts_with("--") || word == "--" ||
        std::find(known.begin(), known.end(), word) != known.end())
      continue;
    const auto near = nearest(word, known);
    return fmt::format("there is no option \"{}\"{}", word,
                       near ? fmt::format("; did you mean \"{}\"?", *near) : "");
  }
  return std::nullopt;
}

}  // namespace whirl::inline io
