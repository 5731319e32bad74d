// Files that are no models at all: what is said about them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "libio/model/model_file.hpp"

namespace whirl::bad_file_test {

namespace fs = std::filesystem;

class BadFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string problem(const fs::path& path) const {
    try {
      read_model(path);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  }
  std::string problem_of(const std::string& content) const {
    std::ofstream(folder / "m.toml", std::ios::binary) << content;
    const std::string found = problem(folder / "m.toml"), name = (folder / "m.toml").string();
    return found.starts_with(name) ? found.substr(name.size()) : found;
  }

  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_bad_input_test_" + std::to_string(::getpid()));
};

TEST_F(BadFile, ThatCannotBeRead) {
  EXPECT_NE(problem(folder / "nothing.toml").find("cannot read the file: No such file"),
            std::string::npos);
  EXPECT_NE(problem(folder).find("this is a directory; expected a model file"), std::string::npos);
}

TEST_F(BadFile, ThatHoldsNoModel) {
  EXPECT_EQ(problem_of(""), ": the file is empty; expected a model file beginning with format = 1");
  EXPECT_EQ(problem_of("\n \n"), problem_of(""));
  EXPECT_EQ(problem_of(std::string("\x7f"
                                   "ELF\x02\x01\0\0",
                                   8)),
            ": this is not a text file; expected a model file (TOML)");
  EXPECT_EQ(problem_of("\x89HDF\r\n\x1a\n"), problem_of(std::string("\0", 1)));
  EXPECT_NE(problem_of("format = 1\n\xff\xfe\n").find("invalid utf-8"), std::string::npos);
}

TEST_F(BadFile, ThatIsNestedTooDeep) {
  EXPECT_NE(problem_of("a = " + std::string(100'000, '[')).find("exceeded maximum nested"),
            std::string::npos);
  std::string tables = "a = ";
  for (int i = 0; i < 100'000; ++i) tables += "{ a = ";
  EXPECT_NE(problem_of(tables).find("not TOML"), std::string::npos);
}

TEST_F(BadFile, WithALineOfAMegabyte) {
  const std::string line(1'000'000, 'x');
  EXPECT_LT(problem_of("format = 1\ntitle = \"" + line).size(), 200u);
  EXPECT_LT(problem_of("format = 1\n" + line + " = 1\n").find("unknown key"), 1'000'100u);
  EXPECT_EQ(problem_of("format = 1\n[[body]]\nname = \"" + line + "\"\nmass = 1\n"), "none");
}

}  // namespace whirl::bad_file_test
