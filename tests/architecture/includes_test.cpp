// Rooms include what is below them only, and each external library has one home.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace includes_test {

namespace fs = std::filesystem;

struct Include {
  std::string file, name;  // both relative to the repository, or the name of a system header
};

std::vector<Include> includes() {
  static const std::regex line_of(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> all;
  const fs::path root = WHIRL_SOURCE_DIR;
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libio", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, line_of)) {
          all.push_back({fs::relative(entry.path(), root).string(), match[1].str()});
        }
      }
    }
  }
  return all;
}

/// Rooms from the ground up; each knows only of those before it.
const std::vector<std::string> floors{
    "libbase/",        "libfe/",          "libcontact/",     "libdyn/system/", "libdyn/flow/",
    "libdyn/taylor/",  "libdyn/methods/", "libdyn/motions/", "libdyn/orbits/", "libdyn/branches/",
    "libdyn/studies/", "libio/text/",     "libio/model/",    "libio/results/", "libio/drawing/",
    "libio/export/",   "libio/figures/",  "libio/page/",     "apps/"};

/// The floor of a file, from 0; -1 of what is in no room.
int floor_of(const std::string& path) {
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (path.rfind(floors[i], 0) == 0) return static_cast<int>(i);
  }
  return -1;
}

TEST(Architecture, IncludesPointDown) {
  const std::vector<Include> all = includes();
  ASSERT_GT(all.size(), 200u);  // the scan found the sources
  for (const Include& i : all) {
    EXPECT_GE(floor_of(i.file), 0) << i.file << " is in no room";
    EXPECT_LE(floor_of(i.name), floor_of(i.file)) << i.file << " includes " << i.name;
  }
}

TEST(Architecture, EachLibraryHasOneHome) {
  const std::vector<std::pair<std::string, std::string>> homes{
      {"Spectra/", "libfe/eigen/"},
      {"Eigen/Sparse(LU|Cholesky)", "lib(base|fe)/"},
      {"cvode/", "libdyn/methods/cvode"},
      {"arkode/", "libdyn/methods/"},
      {"sun", "libdyn/methods/"},
      {"nvector/", "libdyn/methods/"},
      {"toml", "libio/model/config"},
      {"hdf5", "libio/results/hdf5/"},
      {"H5", "libio/results/hdf5/"},
      {"zlib", "libio/results/hdf5/"},
      {"vtk", "libio/export/vtk/"},
      {"CLI/", "apps/command_line.cpp"},
      {"hwy/", "libdyn/taylor/"}};
  for (const Include& i : includes()) {
    if (floor_of(i.name) >= 0) continue;
    for (const auto& [library, home] : homes) {
      if (!std::regex_search(i.name, std::regex("^" + library))) continue;
      EXPECT_TRUE(std::regex_search(i.file, std::regex("^" + home)))
          << i.file << " includes " << i.name << ", whose home is " << home;
    }
  }
}

TEST(Architecture, NoFileIsTooLong) {
  constexpr int most = 450;  // beyond 400 lines look for the second idea; a little slack for tables
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libio", "apps"}) {
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
