// The manual's table of result files says what the columns of results say: every dataset has its row
// there, with its unit and its dimensions, and every attribute is named.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "libio/results/result_schema.hpp"

namespace whirl::result_manual_test {

std::string manual() {
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/command-line.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.substr(text.find("\n## Result file\n"));
}

struct Row {
  std::string unit, dimensions;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Rows by path; one row may be of several datasets.
std::map<std::string, Row> rows_of(const std::string& text) {
  std::map<std::string, Row> rows;
  const std::regex row(R"(\n\|((?: `/[\w/]+`,?)+) \|([^|]*)\|([^|]*)\|)"), path(R"(`(/[\w/]+)`)");
  for (std::sregex_iterator r(text.begin(), text.end(), row), end; r != end; ++r) {
    const std::string paths = (*r)[1];
    for (std::sregex_iterator p(paths.begin(), paths.end(), path); p != end; ++p) {
      rows[(*p)[1]] = {trimmed((*r)[2]), trimmed((*r)[3])};
    }
  }
  return rows;
}

std::ptrdiff_t count_of(const std::string& list, char separator) {
  return list.empty() ? 0 : std::count(list.begin(), list.end(), separator) + 1;
}

TEST(ResultManual, SaysWhatColumnsSay) {
  const std::string text = manual();
  const std::map<std::string, Row> rows = rows_of(text);
  int stated = 0;
  for (const ResultSet& set : result_schema()) {
    for (const ResultEntry& e : set.entries) {
      if (e.meaning.empty()) continue;  // not by columns
      ++stated;
      const std::size_t at = e.path.find('@');
      if (at != std::string::npos) {
        const std::string name = "`" + e.path.substr(at + 1) + "`";
        EXPECT_NE(text.find(name), std::string::npos) << e.path;
        continue;
      }
      const auto row = rows.find(e.path);
      if (row == rows.end()) {
        ADD_FAILURE() << fmt::format("missing:\n| `{}` | {} | {} | {} |", e.path, e.unit, e.sizes,
                                     e.meaning);
        continue;
      }
      EXPECT_EQ(row->second.unit, e.unit) << e.path;
      EXPECT_EQ(count_of(row->second.dimensions, ','), count_of(e.sizes, ' ')) << e.path;
    }
  }
  EXPECT_GE(stated, 60);
}

}  // namespace whirl::result_manual_test
