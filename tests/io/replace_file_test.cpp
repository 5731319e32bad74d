// Files that take their place when they are complete.

#include "libio/results/replace_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace whirl::replace_file_test {

namespace fs = std::filesystem;

class ReplaceFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  static std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }

  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_replace_file_test_" + std::to_string(::getpid()));
  const fs::path place = folder / "a.txt";
};

TEST_F(ReplaceFile, WritesAndReplaces) {
  replace_file(place, "old");
  EXPECT_EQ(content(place), "old");
  replace_file(place, "new", Replaces::anything);
  EXPECT_EQ(content(place), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ReplaceFile, WithoutCommitNothingChanges) {
  replace_file(place, "old");
  {
    const FileReplacement file(place, Replaces::anything);
    std::ofstream(file.temporary()) << "half of the n";
    EXPECT_EQ(content(place), "old");
  }
  EXPECT_EQ(content(place), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ReplaceFile, LinksStay) {
  replace_file(place, "old");
  const fs::path link = folder / "link.txt";
  fs::create_symlink("a.txt", link);
  replace_file(link, "new", Replaces::anything);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(place), "new");
}

// A file that somebody else wrote stays, unless it is empty or this is asked for.
TEST_F(ReplaceFile, KeepsWhatOthersWrote) {
  for (const std::string text :
       {"a", "{\"model\": 1}", "<svg></svg>", "\x89HDF\r\n\x1a\n", "%PDF-1.5"}) {
    replace_file(place, text, Replaces::anything);
    for (const Replaces what : {Replaces::own_pictures, Replaces::own_results}) {
      EXPECT_THROW(replace_file(place, "new", what), TakenPlace) << text;
    }
    EXPECT_EQ(content(place), text);
  }
  replace_file(place, "", Replaces::anything);
  replace_file(place, "new");
  EXPECT_EQ(content(place), "new");
}

TEST_F(ReplaceFile, RefusesWhatIsNotAFile) {
  const auto problem = [](const fs::path& path) -> std::string {
    try {
      replace_file(path, "text");
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(problem("/dev/null"), "cannot write /dev/null: it is not a file");
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
  EXPECT_EQ(problem(folder), "cannot write " + folder.string() + ": it is a directory");
  const std::string inside = (folder / "none/a.txt").string();
  EXPECT_EQ(problem(inside),
            "cannot write " + inside + ": there is no directory " + (folder / "none").string());
  EXPECT_EQ(problem(""), "cannot write : this is not the name of a file");
}

}  // namespace whirl::replace_file_test
