// What a command would overwrite is found before its work.

#include "libio/results/command_files.hpp"

#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace command_files_test {

class CommandFilesTest : public InResultFolder {
 protected:
  std::string at(const char* name) const { return (folder / name).string(); }
  static std::string problem(const CommandFiles& files) {
    return problem_of([&] { require_free_places(files); });
  }
};

TEST_F(CommandFilesTest, WhatIsReadIsNotLost) {
  const CommandFiles none{.input = at("a.toml"), .out = at("a.h5"), .json = at("a.json")};
  EXPECT_EQ(problem(none), "none");
  EXPECT_EQ(files(), 0u);
  EXPECT_EQ(problem({.input = at("a.toml"), .out = at("a.toml"), .is_forced = true}),
            "cannot write " + at("a.toml") + ": it is the input of this command");
  EXPECT_EQ(problem({.others = {at("b.h5")}, .out = at("b.h5"), .out_kind = OutKind::picture}),
            "cannot write " + at("b.h5") + ": this command reads it");
  EXPECT_EQ(problem({.input = at("a.toml"), .svg = at("a.toml")}),
            "cannot write " + at("a.toml") + ": it is the input of this command");
  EXPECT_EQ(problem({.from = at("b.h5"), .json = at("b.h5")}),
            "cannot write " + at("b.h5") + ": --from reads it");
  EXPECT_EQ(problem({.out = at("b"), .out_kind = OutKind::stem, .json = at("b")}),
            "cannot write " + at("b") + ": --out and --json name the same file");
}

TEST_F(CommandFilesTest, OfWhatIsThereOwnFilesAreReplacedOrAnythingByForce) {
  std::ofstream(folder / "mine.txt") << "what somebody wrote\n";
  for (const bool is_forced : {false, true}) {
    for (const CommandFiles& files :
         {CommandFiles{.out = at("mine.txt"), .is_forced = is_forced},
          CommandFiles{.svg = at("mine.txt"), .is_forced = is_forced},
          CommandFiles{.json = at("mine.txt"), .is_forced = is_forced}}) {
      EXPECT_EQ(problem(files) == "none", is_forced) << problem(files);
    }
  }
  EXPECT_EQ(problem({.out = at("mine.txt"), .out_kind = OutKind::stem}), "none");
  EXPECT_NE(problem({.svg = ""}), "none");
}

}  // namespace command_files_test
}  // namespace whirl::test
