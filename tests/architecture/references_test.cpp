// What is cited can be looked up: every [Key] of sources and documents has its entry in
// docs/references.md, and no entry is left over.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace references_test {

namespace fs = std::filesystem;
const fs::path root = WHIRL_SOURCE_DIR;
const fs::path list = root / "docs/references.md";

/// Calls f with every line of a file.
template <class F>
void for_each_line(const fs::path& path, F f) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) f(line);
}

/// Keys that are cited, each with a file that does.
std::map<std::string, std::string> citations() {
  static const std::regex key(R"(\[([A-Z][A-Za-z]*[0-9]{4}[a-z]?)\])");
  std::vector<fs::path> files{root / "README.md", root / "CONTRIBUTING.md"};
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libdata", "libio",
                             "libverbs", "apps", "bench", "docs", "models", "tests", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file() && entry.path() != list) files.push_back(entry.path());
    }
  }
  std::map<std::string, std::string> found;
  for (const fs::path& path : files) {
    for_each_line(path, [&](const std::string& line) {
      for (std::sregex_iterator i(line.begin(), line.end(), key), end; i != end; ++i) {
        found[(*i)[1].str()] = fs::relative(path, root).string();
      }
    });
  }
  return found;
}

std::vector<std::string> entries() {
  static const std::regex entry(R"(^- \[([A-Z][A-Za-z]*[0-9]{4}[a-z]?)\] \S)");
  std::vector<std::string> keys;
  for_each_line(list, [&](const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, entry)) keys.push_back(match[1].str());
  });
  return keys;
}

TEST(References, EveryKeyThatIsCitedHasAnEntry) {
  const auto cited = citations();
  ASSERT_GT(cited.size(), 20u);  // the scan found the sources
  const std::vector<std::string> keys = entries();
  for (const auto& [key, file] : cited) {
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 1)
        << file << " cites [" << key << "]: entries in docs/references.md";
  }
}

TEST(References, EveryEntryIsCitedAndInItsPlace) {
  const auto cited = citations();
  const std::vector<std::string> keys = entries();
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  for (const std::string& key : keys) {
    EXPECT_TRUE(cited.contains(key)) << "nothing cites [" << key << "]";
  }
}

}  // namespace references_test
