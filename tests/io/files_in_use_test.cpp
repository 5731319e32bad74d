// What a call reads is not written, and no file is written by two.

#include "libio/text/files_in_use.hpp"

#include "libio/text/option_values.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace files_in_use_test {

namespace fs = std::filesystem;

class FilesInUseTest : public InResultFolder {
 protected:
  fs::path at(const char* name) const { return folder / name; }
};

// Two names of one file: by "..", by links of both kinds, and by links whose targets are not there
// yet.
TEST_F(FilesInUseTest, NamesOfOneFileAreTheSame) {
  std::ofstream(at("a.csv")) << "1";
  fs::create_hard_link(at("a.csv"), at("hard.csv"));
  fs::create_symlink("a.csv", at("soft.csv"));
  fs::create_symlink("soft.csv", at("softer.csv"));
  fs::create_symlink("nothing.csv", at("dangling.csv"));
  fs::create_symlink("round.csv", at("round.csv"));
  for (const char* name : {"a.csv", "hard.csv", "soft.csv", "softer.csv", "./x/../a.csv"}) {
    EXPECT_TRUE(is_same_file(at("a.csv"), at(name))) << name;
  }
  EXPECT_TRUE(is_same_file(at("dangling.csv"), at("nothing.csv")));
  EXPECT_FALSE(is_same_file(at("dangling.csv"), at("a.csv")));
  EXPECT_FALSE(is_same_file(at("round.csv"), at("a.csv")));
  EXPECT_FALSE(is_same_file("", ""));
}

TEST_F(FilesInUseTest, WhatIsReadIsNotWritten) {
  const FilesInUse files;
  std::ofstream(at("a.csv")) << "1";
  fs::create_symlink("a.csv", at("link.csv"));
  EXPECT_EQ(problem_of_reading(at("a.csv")), "");
  EXPECT_EQ(problem_of_writing(at("link.csv")), "this command reads it");
  EXPECT_EQ(problem_of_output(at("link.csv"), "--out"), "this command reads it");
  for (const Replaces what : {Replaces::own_pictures, Replaces::anything}) {
    EXPECT_THROW(replace_file(at("link.csv"), "2", what), FileError);
  }
  EXPECT_EQ(problem_of_writing(at("b.csv")), "");
}

TEST_F(FilesInUseTest, WhatIsToBeWrittenIsNotRead) {
  const FilesInUse files;
  EXPECT_EQ(problem_of_output(at("a.h5"), "--out"), "");
  EXPECT_EQ(problem_of_reading(at("a.h5")), "--out would replace it");
  const LooksAtOutput look;  // at what is replaced, or gone on with
  EXPECT_EQ(problem_of_reading(at("a.h5")), "");
}

TEST_F(FilesInUseTest, NoFileIsWrittenByTwo) {
  const FilesInUse files;
  EXPECT_EQ(problem_of_output(at("a.h5"), "--out"), "");
  EXPECT_EQ(problem_of_output(at("b.json"), "--json", true), "");
  EXPECT_EQ(problem_of_output(at("a.h5"), "--svg"), "--out and --svg name the same file");
  EXPECT_EQ(problem_of_writing(at("a.h5")), "");
  EXPECT_EQ(problem_of_writing(at("b.json")), "--json names this file, too");
  begin_last_output(at("b.json"));
  EXPECT_EQ(problem_of_writing(at("b.json")), "");
}

// A list is that of its call: within it there is no other, and after it there is none.
TEST_F(FilesInUseTest, AListEndsWithItsCall) {
  {
    const FilesInUse files;
    {
      const FilesInUse within;
      EXPECT_EQ(problem_of_reading(at("a.csv")), "");
    }
    EXPECT_NE(problem_of_writing(at("a.csv")), "");
  }
  EXPECT_EQ(problem_of_writing(at("a.csv")), "");
}

// An ending that says another format is refused; one that says none, and none, are taken.
TEST_F(FilesInUseTest, EndingsSayWhatIsWritten) {
  for (const char* right : {"x.html", "x.HTM", "x", "x.2024", "a.pdf/x", ".html"}) {
    EXPECT_EQ(ending_problem(right, ".html .htm"), "") << right;
  }
  for (const char* wrong : {"x.pdf", "x.PDF", "x.h5", "x.html.json"}) {
    EXPECT_NE(ending_problem(wrong, ".html .htm"), "") << wrong;
  }
  EXPECT_EQ(ending_problem("x.pdf", ".html .htm"),
            "what is written is no pdf file, expected a name that ends in .html");
  EXPECT_EQ(ending_problem("x.pdf", ""), "");
  EXPECT_EQ(ending_problem("-", ".json -"), "");
  EXPECT_NE(ending_problem("-", ".json"), "");
  EXPECT_NE(ending_problem("-", ""), "");
}

}  // namespace files_in_use_test
}  // namespace whirl::test
