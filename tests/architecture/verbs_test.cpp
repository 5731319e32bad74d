// A verb is one file and one line of the list.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace architecture_verbs_test {

namespace fs = std::filesystem;

/// Lines of the program's sources that match, by their files.
std::map<std::string, int> places_of(const std::string& pattern) {
  const std::regex searched(pattern);
  std::map<std::string, int> places;
  const fs::path root = fs::path(WHIRL_SOURCE_DIR) / "apps";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (std::regex_search(line, searched)) ++places[fs::relative(entry.path(), root).string()];
    }
  }
  return places;
}

std::vector<std::string> names_in_the_list() {
  std::vector<std::string> names;
  std::ifstream file(fs::path(WHIRL_SOURCE_DIR) / "apps/verbs.cpp");
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, match, std::regex(R"(\b(\w+)_verb\(\))"))) {
      names.push_back(match[1]);
    }
  }
  return names;
}

TEST(Verbs, EachIsOneFileAndOneLineOfTheList) {
  const std::vector<std::string> names = names_in_the_list();
  EXPECT_GE(names.size(), 24u);
  for (const std::string& name : names) {
    const std::string own = "verbs/" + name + ".cpp";
    // its functions: one that describes it, and one that runs it
    EXPECT_EQ(places_of("\\b" + name + "_verb\\b"),
              (std::map<std::string, int>{{own, 1}, {"verbs.cpp", 1}}));
    EXPECT_EQ(places_of("\\brun_" + name + "\\b"), (std::map<std::string, int>{{own, 2}}));
    EXPECT_EQ(places_of("\\.name = \"" + name + "\""), (std::map<std::string, int>{{own, 1}}));
  }
}

// One whose name is no common word: nothing else of the program knows its name as that of a verb.
TEST(Verbs, UnbalanceIsNamedNowhereElse) {
  const auto places = places_of("\"unbalance\"|unbalance_verb|run_unbalance");
  EXPECT_EQ(places, (std::map<std::string, int>{{"verbs/unbalance.cpp", 4}, {"verbs.cpp", 1}}));
}

}  // namespace architecture_verbs_test
