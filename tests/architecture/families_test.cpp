// A member of a family is one file and one line of its list.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace families_test {

namespace fs = std::filesystem;

/// Lines of the sources of a folder that match, by their files.
std::map<std::string, int> places_in(const char* folder, const std::string& pattern) {
  const std::regex searched(pattern);
  std::map<std::string, int> places;
  const fs::path root = fs::path(WHIRL_SOURCE_DIR) / folder;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (std::regex_search(line, searched)) ++places[fs::relative(entry.path(), root).string()];
    }
  }
  return places;
}

/// The same among verbs and in the programs.
std::map<std::string, int> places_of(const std::string& pattern) {
  std::map<std::string, int> places = places_in("libverbs", pattern);
  places.merge(places_in("apps", pattern));
  return places;
}

/// Members by the functions of a list that describe them, such as modes_verb().
std::vector<std::string> names_in(const char* list, const std::string& family) {
  std::vector<std::string> names;
  std::ifstream file(fs::path(WHIRL_SOURCE_DIR) / list);
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, match, std::regex("\\b(\\w+)_" + family + "\\(\\)"))) {
      names.push_back(match[1]);
    }
  }
  return names;
}

TEST(Verbs, EachIsOneFileAndOneLineOfTheList) {
  const std::vector<std::string> names = names_in("libverbs/verbs/verbs.cpp", "verb");
  EXPECT_GE(names.size(), 24u);
  for (const std::string& name : names) {
    const std::string own = "verbs/" + name + ".cpp";
    // its functions: one that describes it, and one that runs it
    EXPECT_EQ(places_of("\\b" + name + "_verb\\b"),
              (std::map<std::string, int>{{own, 1}, {"verbs/verbs.cpp", 1}}));
    EXPECT_EQ(places_of("\\brun_" + name + "\\b"), (std::map<std::string, int>{{own, 2}}));
    EXPECT_EQ(places_of("\\.name = \"" + name + "\""), (std::map<std::string, int>{{own, 1}}));
  }
}

// One whose name is no common word: nothing else of the program knows its name as that of a verb.
TEST(Verbs, UnbalanceIsNamedNowhereElse) {
  const auto places = places_of("\"unbalance\"|unbalance_verb|run_unbalance");
  EXPECT_EQ(places,
            (std::map<std::string, int>{{"verbs/unbalance.cpp", 4}, {"verbs/verbs.cpp", 1}}));
}

// What is longer computes, reads or writes something that belongs into a library below.
TEST(Verbs, AreShort) {
  constexpr int most = 120;  // lines
  for (const auto& entry :
       fs::directory_iterator(fs::path(WHIRL_SOURCE_DIR) / "libverbs" / "verbs")) {
    std::ifstream file(entry.path());
    EXPECT_LE(std::count(std::istreambuf_iterator<char>(file), {}, '\n'), most) << entry.path();
  }
}

TEST(Figures, EachIsDescribedInOneFileAndALineOfTheList) {
  const std::vector<std::string> names = names_in("libio/figures/figures.cpp", "kind");
  EXPECT_GE(names.size(), 29u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    auto named = places_in("libio", "\\.name = \"" + name + "\"");
    std::erase_if(named, [](const auto& place) { return !place.first.starts_with("figures/"); });
    ASSERT_EQ(named.size(), 1u);
    const std::string own = named.begin()->first;
    EXPECT_EQ(places_in("libio", "\\b" + name + "_kind\\("),
              (std::map<std::string, int>{{own, 1}, {"figures/figures.cpp", 1}}));
    // the page asks figures for what it adds to them, not for their names
    EXPECT_TRUE(places_in("web", "kind [!=]== \"" + name + "\"").empty());
  }
}

// A table of model files: reader, schema, Python builder and the manual's test ask the list.
TEST(ModelTables, EachIsAFileAndOneLineOfTheList) {
  const std::vector<std::string> names = names_in("libio/model/model_tables.cpp", "table");
  EXPECT_GE(names.size(), 18u);
  for (const std::string& name : names) {
    EXPECT_EQ(
        places_in("libio/model", "\\b" + name + "_table\\("),
        (std::map<std::string, int>{{"tables/" + name + ".cpp", 1}, {"model_tables.cpp", 1}}));
  }
  for (const char* folder : {"python/whirl", "python/module"}) {
    EXPECT_TRUE(places_in(folder, "\"oil_film\"").empty()) << folder;
  }
}

// A ring's contact law: a file, its include and its place in the list.
TEST(ContactLaws, HertzIsAFileAndTwoLinesOfTheList) {
  const auto places = places_in("libcontact", "\\bHertz<|laws/hertz");
  std::map<std::string, int> outside = places;
  outside.erase("laws/hertz.hpp");
  outside.erase("rolling_bearing.hpp");  // whose balls are pressed by it
  EXPECT_EQ(outside, (std::map<std::string, int>{{"laws.hpp", 2}}));
  for (const char* folder : {"libfe", "libdyn", "libdata", "libio", "libverbs", "apps"}) {
    EXPECT_TRUE(places_in(folder, "\\bHertz<|laws/hertz").empty()) << folder;
  }
}

// A kind of bearing: a file, its include and its place in the list.
TEST(Bearings, TableBearingIsAFileAndTwoLinesOfTheList) {
  auto places = places_in("libfe", "\\bTableBearing\\b|bearings/table");
  places.erase("parts/bearings/table.hpp");
  EXPECT_EQ(places, (std::map<std::string, int>{{"parts/bearings.hpp", 2}}));
  for (const char* folder : {"libcontact", "libdyn", "libdata", "libio", "libverbs", "apps"}) {
    EXPECT_TRUE(places_in(folder, "\\bTableBearing\\b|bearings/table").empty()) << folder;
  }
}

// Nothing asks for the first kind, either: only the list knows what kinds there are.
TEST(Bearings, NoCodeAsksForAKind) {
  for (const char* folder :
       {"libfe", "libcontact", "libdyn", "libdata", "libio", "libverbs", "apps"}) {
    EXPECT_TRUE(
        places_in(folder, "(get_if|get|holds_alternative)<(Constant|Table)Bearing>").empty())
        << folder;
  }
}

// A contact geometry: likewise. Equations, events, orbits, model files and pictures ask it, and
// none knows it by name.
void expect_file_and_two_lines(const std::string& named, const std::string& file) {
  std::map<std::string, int> outside = places_in("libcontact", named);
  EXPECT_EQ(outside.erase(file), 1u);
  EXPECT_EQ(outside, (std::map<std::string, int>{{"geometries.hpp", 2}}));
  for (const char* folder : {"libfe", "libdyn", "libdata", "libio", "libverbs", "apps"}) {
    EXPECT_TRUE(places_in(folder, named).empty()) << folder;
  }
}
TEST(Geometries, AStopIsAFileAndTwoLinesOfTheList) {
  expect_file_and_two_lines("\\bStop\\b|geometry/stop", "geometry/stop.hpp");
}
// A curved wall, too: lanes and their derivatives take its formulas from there.
TEST(Geometries, AnEllipseIsAFileAndTwoLinesOfTheList) {
  expect_file_and_two_lines("\\bEllipse\\b|geometry/ellipse", "geometry/ellipse.hpp");
}

}  // namespace families_test
