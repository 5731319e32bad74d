// Rooms include what is below them only, and each external library has one home.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace includes_test {

namespace fs = std::filesystem;

constexpr std::array folders{"libbase", "libfe",    "libcontact", "libdyn", "libdata",
                             "libio",   "libverbs", "apps",       "python"};

struct Include {
  std::string file, name;  // both relative to the repository, or the name of a system header
};

/// A file, and of one of its lines what a pattern matches: its group 1, or all if it has none.
using Lines = std::vector<std::pair<std::string, std::string>>;

Lines lines_in(const std::string& folder, const std::regex& pattern) {
  Lines lines;
  const fs::path root = WHIRL_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
      if (!std::regex_search(line, match, pattern)) continue;
      lines.emplace_back(fs::relative(entry.path(), root).string(), match[match.size() - 1].str());
    }
  }
  return lines;
}

std::vector<Include> includes() {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> all;
  for (const char* folder : folders) {
    for (const auto& [file, name] : lines_in(folder, pattern)) all.push_back({file, name});
  }
  return all;
}

/// Rooms from the ground up; each knows only of those before it.
const std::vector<std::string> floors{"libbase/",
                                      "libbase/structs/",
                                      "libbase/system/",
                                      "libbase/numerics/",
                                      "libbase/processes/",
                                      "libfe/parts/",
                                      "libfe/mesh/",
                                      "libfe/eigen/",
                                      "libfe/assembly/",
                                      "libfe/analyses/",
                                      "libfe/lateral/",
                                      "libcontact/",
                                      "libdyn/system/",
                                      "libdyn/linear/",
                                      "libdyn/flow/",
                                      "libdyn/taylor/",
                                      "libdyn/methods/",
                                      "libdyn/motions/",
                                      "libdyn/orbits/",
                                      "libdyn/branches/",
                                      "libdyn/studies/",
                                      "libdata/measured/",
                                      "libdata/balancing/",
                                      "libdata/fit/",
                                      "libio/text/",
                                      "libio/model/",
                                      "libio/results/",
                                      "libio/import/",
                                      "libio/measured/",
                                      "libio/texts/",
                                      "libio/drawing/",
                                      "libio/export/",
                                      "libio/figures/",
                                      "libio/page/",
                                      "libverbs/command/",
                                      "libverbs/options/",
                                      "libverbs/verbs/",
                                      "apps/",
                                      "python/"};

/// The floor of a file, from 0: of the innermost room that it is in; -1 of what is in none.
int floor_of(const std::string& path) {
  int found = -1;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (path.rfind(floors[i], 0) != 0) continue;
    const bool is_inside =
        found >= 0 && floors[i].size() < floors[static_cast<std::size_t>(found)].size();
    if (!is_inside) found = static_cast<int>(i);
  }
  return found;
}

TEST(Architecture, IncludesPointDown) {
  const std::vector<Include> all = includes();
  ASSERT_GT(all.size(), 200u);  // the scan found the sources
  for (const Include& i : all) {
    EXPECT_GE(floor_of(i.file), 0) << i.file << " is in no room";
    EXPECT_LE(floor_of(i.name), floor_of(i.file)) << i.file << " includes " << i.name;
  }
}

// Both stand on verbs, beside each other.
TEST(Architecture, ThePythonPackageNeedsNoProgram) {
  for (const Include& i : includes()) {
    if (i.file.rfind("python/", 0) != 0) continue;
    EXPECT_NE(i.name.rfind("apps/", 0), 0u) << i.file << " includes " << i.name;
  }
}

// What a program tells people goes through say(), which lets nothing through that steers a
// terminal.
TEST(Architecture, OneFunctionPrints) {
  static const std::regex pattern(R"(\b(fmt::print|f?puts|printf|fwrite)\(|std::c(out|err)\b)");
  for (const char* folder : {"libio", "libverbs", "apps"}) {
    for (const auto& [file, what] : lines_in(folder, pattern)) {
      const bool may = file == "libio/text/terminal.cpp" ||
                       file == "libio/text/progress_line.cpp" ||
                       file.rfind("libio/export/vtk/render/", 0) == 0;
      EXPECT_TRUE(may) << file << " prints by " << what
                       << ", expected say() of libio/text/terminal.hpp";
    }
  }
}

TEST(Architecture, EachLibraryHasOneHome) {
  const std::vector<std::pair<std::string, std::string>> homes{
      {"Spectra/", "libfe/eigen/"},
      {"klu", "libbase/numerics/sparse_lu"},
      {"Eigen/Sparse(LU|Cholesky)", "lib(base/numerics|fe/eigen)/"},
      {"cvode/", "libdyn/methods/cvode"},
      {"arkode/", "libdyn/methods/"},
      {"sun", "libdyn/methods/"},
      {"nvector/", "libdyn/methods/"},
      {"toml", "libio/model/config"},
      {"hdf5", "libio/results/hdf5/"},
      {"H5", "libio/results/hdf5/"},
      {"zlib", "libio/results/hdf5/"},
      {"matio", "libio/results/matlab_variables"},
      {"minizip", "libio/text/workbook"},
      {"pugixml", "libio/text/workbook"},
      {"vtk", "libio/export/vtk/"},
      {"CLI/", "libverbs/command/command_line.cpp"},
      {"hwy/", "libdyn/taylor/"},
      {"mpi\\.h", "apps/mpi/"},
      {"pybind11/", "python/module/"}};
  for (const Include& i : includes()) {
    if (floor_of(i.name) >= 0) continue;
    for (const auto& [library, home] : homes) {
      if (!std::regex_search(i.name, std::regex("^" + library))) continue;
      EXPECT_TRUE(std::regex_search(i.file, std::regex("^" + home)))
          << i.file << " includes " << i.name << ", whose home is " << home;
    }
  }
}

/// Libraries from the ground up with their namespaces, which are inline: `whirl::Model` is a name,
/// too.
const std::vector<std::pair<std::string, std::string>> namespaces{
    {"libbase", "base"}, {"libfe", "fe"},     {"libcontact", "contact"},
    {"libdyn", "dyn"},   {"libdata", "data"}, {"libio", "io"},
    {"libverbs", "cli"}, {"apps", "cli"},     {"python", "python"}};

TEST(Architecture, ALibraryDeclaresInItsNamespaceOrInOneBelow) {
  std::size_t found = 0;
  for (auto own = namespaces.begin(); own != namespaces.end(); ++own) {
    for (const auto& place : lines_in(own->first, std::regex("^namespace whirl.*"))) {
      const std::string& line = place.second;
      ++found;
      const bool is_known = std::any_of(namespaces.begin(), own + 1, [&](const auto& n) {
        return std::regex_search(line, std::regex("^namespace whirl::inline " + n.second + "\\b"));
      });
      EXPECT_TRUE(is_known) << place.first << ": " << line;
    }
  }
  EXPECT_GT(found, 400u);
}

// To the linker two types of one name in a namespace are one: it takes the functions of either for
// both. No compiler tells it where no file includes both headers.
TEST(Architecture, NoTwoHeadersDefineATypeOfOneName) {
  const std::regex opened(R"(^((?:namespace whirl|struct|class|enum class)\b[^;]*\{))");
  const std::regex type(R"(^(?:struct|class|enum class) (\w+))");
  std::map<std::string, std::string> homes;  // of names with their namespaces
  for (const auto& own : namespaces) {
    std::string space;
    for (const auto& [file, line] : lines_in(own.first, opened)) {
      std::smatch name;
      if (line.starts_with("namespace")) space = line;
      if (!file.ends_with(".hpp") || !std::regex_search(line, name, type)) continue;
      const auto [home, is_new] = homes.try_emplace(space + ' ' + name[1].str(), file);
      EXPECT_TRUE(is_new || home->second == file)
          << name[1] << " of " << file << " is also in " << home->second;
    }
  }
  EXPECT_GT(homes.size(), 500u);
}

// What stands where in a state, StateLayout says. Orders of orbits and halves of periods are
// others' numbers.
TEST(Architecture, OneFileKnowsTheOrderOfAState) {
  const std::regex order(R"(\b2 \* n_?\b|\b2 \* [a-z_.>-]*coordinates\(\)|)"
                         R"(\by(_\.data\(\))? \+ n_?\b|\by\.(head|tail)\(|)"
                         R"(\b(head|tail|topRows|bottomRows)\([a-z_.]*coordinates\(\)\))");
  const auto spoken = [&](const char* folder) {
    Lines found = lines_in(folder, order);
    std::erase_if(found, [](const auto& at) { return at.first == "libdyn/system/layout.hpp"; });
    return found;
  };
  for (const char* folder : {"libdyn", "libdata"}) {
    for (const auto& [file, words] : spoken(folder)) {
      ADD_FAILURE() << file << " splits a state by hand: " << words
                    << ", expected StateLayout of libdyn/system/layout.hpp";
    }
  }
  EXPECT_FALSE(lines_in("tests", order).empty());  // the pattern finds what it looks for
}

// They serve programs of any kind: what is wrong they say in words of the field, and the program
// adds which of its options does it (OptionError).
TEST(Architecture, LibrariesThatComputeDoNotSpeakCommandLine) {
  const std::regex option(R"("[^"]*--[a-z])");
  const std::regex verb(
      R"("[^"]*\bwhirl (?:bench|classify|continue|map|orbit|simulate|sweep|torus|unbalance)\b)");
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libdata"}) {
    for (const std::regex* spoken : {&option, &verb}) {
      for (const auto& [file, words] : lines_in(folder, *spoken)) {
        // what was not given for a check is told as an option in JSON and files, which stays
        if (file == "libdyn/linear/lateral_stability.cpp") continue;
        ADD_FAILURE() << file << " speaks of the command line: " << words;
      }
    }
  }
  EXPECT_FALSE(lines_in("libverbs", option).empty());  // where it may
}

// What all methods stand on has tests of its own, which a change of it is found by.
TEST(Architecture, EveryHeaderOfTheEquationsHasATest) {
  std::string tests;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(WHIRL_SOURCE_DIR) / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("#include \"libdyn/")) tests += line + '\n';
    }
  }
  for (const std::string room : {"libdyn/system", "libdyn/flow"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(WHIRL_SOURCE_DIR) / room)) {
      if (entry.path().extension() != ".hpp") continue;
      const std::string name = room + '/' + entry.path().filename().string();
      EXPECT_NE(tests.find("\"" + name + "\""), std::string::npos) << name;
    }
  }
}

TEST(Architecture, NoFileIsTooLong) {
  constexpr int most = 450;  // beyond 400 lines look for the second idea; a little slack for tables
  for (const char* folder : folders) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(WHIRL_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
      std::ifstream file(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
      EXPECT_LE(lines, most) << entry.path();
    }
  }
}

}  // namespace includes_test
