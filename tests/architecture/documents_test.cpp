// Files and folders that documents name are there.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace documents_test {

namespace fs = std::filesystem;

std::vector<fs::path> documents() {
  std::vector<fs::path> all;
  const fs::path root = WHIRL_SOURCE_DIR;
  for (const char* folder : {"", "docs", "libbase", "libfe", "libcontact", "libdyn", "libio"}) {
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      if (entry.path().extension() == ".md") all.push_back(entry.path());
    }
  }
  return all;
}

TEST(Documents, NameFilesThatAreThere) {
  static const std::regex path_of(
      "`((libbase|libfe|libcontact|libdyn|libio|apps|tests|models|tools|web|docs)/[A-Za-z0-9_./"
      "-]+)`");
  int found = 0;
  for (const fs::path& document : documents()) {
    std::ifstream file(document);
    std::ostringstream text;
    text << file.rdbuf();
    const std::string all = text.str();
    for (std::sregex_iterator i(all.begin(), all.end(), path_of), end; i != end; ++i) {
      ++found;
      EXPECT_TRUE(fs::exists(fs::path(WHIRL_SOURCE_DIR) / (*i)[1].str()))
          << document << " names " << (*i)[1];
    }
  }
  EXPECT_GT(found, 50);
}

}  // namespace documents_test
