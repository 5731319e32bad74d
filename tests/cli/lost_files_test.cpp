// No file is lost to a call that reads it, to another output of the same call, or to a line that a
// stranger's file holds.

#include <map>

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace lost_files_test {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class LostFiles : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
    write("other.toml", rubbing);
    write("table.csv", "speed [rpm], kxx [N/m], kyy [N/m]\n0, 1e5, 1e5\n9000, 1e5, 1e5\n");
    write("tables.toml",
          "format = 1\n[operation]\nspeed = \"900 rpm\"\n[[body]]\nname = \"rotor\"\nmass = 2\n"
          "spins = true\n[[bearing]]\nname = \"shaft\"\nbody = \"rotor\"\ntable = \"table.csv\"\n");
    write("probes.toml",
          "[[probe]]\nname = \"X\"\nbody = \"rotor\"\nangle = \"0 deg\"\n"
          "[[probe]]\nname = \"Y\"\nbody = \"rotor\"\nangle = \"90 deg\"\n");
    for (const char* name : {"run", "run2"}) {
      ASSERT_EQ(whirl(with(motion, {"--out", std::string(name) + ".h5", "--measure", "probes.toml",
                                    "--measured-out", std::string(name) + ".csv"}))
                    .status,
                0);
    }
  }

  /// Expects that a line is refused in words and changes no file.
  void expect_refused(const Words& words, const std::string& part) const {
    SCOPED_TRACE(words[0] + " ... " + words[words.size() - 2] + " " + words.back());
    std::map<std::string, std::string> before;
    for (const std::string& file : files()) before[file] = content(folder / file);
    const Outcome refused = whirl(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.err, part)) << refused.err;
    std::map<std::string, std::string> after;
    for (const std::string& file : files()) after[file] = content(folder / file);
    EXPECT_EQ(after, before);
  }

  const Words motion{"simulate", "rub.toml", "--revolutions", "30", "--discard", "4", "--quiet"};
};

// The ending of a name says what is in a file: a page called x.docx is damaged for every reader of
// Word.
TEST_F(LostFiles, AnEndingThatSaysAnotherFormatIsRefused) {
  const std::string ross = WHIRL_SOURCE_DIR "/models/layered_ross.json";
  const std::vector<std::pair<Words, std::string>> calls{
      {{"report", "run.h5", "--out", "x.docx"}, "--out x.docx: what is written is no docx file"},
      {{"report", "run.h5", "--out", "x.PNG"}, "expected a name that ends in .html"},
      {{"modes", "rub.toml", "--out", "x.csv"}, "expected a name that ends in .h5"},
      {{"modes", "rub.toml", "--json", "x.h5"}, "expected a name that ends in .json"},
      {{"import", ross, "--out", "x.json"}, "expected a name that ends in .toml"},
      {{"plot", "run.h5", "orbit", "--format", "svg", "--out", "x.pdf"}, "ends in .svg"},
      {{"bench", "rub.toml", "--svg", "x.png"}, "expected a name that ends in .svg"},
      {{"schema", "--out", "x.html"}, "expected a name that ends in .json"},
      {with(motion, {"--measured-out", "x.png", "--measure", "probes.toml"}), "expected a record"},
      {{"animate", "run.h5", "--out", "x.avi"}, "expected a video"}};
  for (const auto& [words, part] : calls) expect_refused(words, part);
  EXPECT_EQ(whirl({"modes", "rub.toml", "--out", "x.result", "--json", "x.answer"}).status, 0);
}

// Standard output is for --json, in every verb: no file is called "-".
TEST_F(LostFiles, StandardOutputIsNoFile) {
  const std::string ross = WHIRL_SOURCE_DIR "/models/layered_ross.json";
  for (const Words& words : {Words{"report", "run.h5", "--out", "-"},
                             {"modes", "rub.toml", "--out", "-"},
                             {"import", ross, "--out", "-"},
                             {"plot", "run.h5", "orbit", "--out", "-"},
                             {"plot", "run.h5", "orbit", "--format", "svg", "--out", "-"},
                             {"bench", "rub.toml", "--svg", "-"},
                             {"schema", "--out", "-"},
                             {"export", "run.h5", "--out", "-"},
                             {"animate", "run.h5", "--out", "-"},
                             with(motion, {"--measured-out", "-", "--measure", "probes.toml"})}) {
    expect_refused(words, "expected the name of a file; standard output, -, is for --json");
  }
}

// Whatever a call reads, and by whatever name, no output of it is written there.
TEST_F(LostFiles, WhatIsReadIsNotWrittenEvenByForce) {
  write("records.toml", "[[record]]\nfile = \"run.csv\"\nspeed = \"100 rad/s\"\n");
  const Words fit{"fit",      "rub.toml",    "--measured", "run.csv",
                  "--probes", "probes.toml", "--free",     "contact.ring.stiffness"};
  const Words measured{"identify", "rub.toml", "--measured", "run.csv", "--probes", "probes.toml"};
  fs::create_symlink("table.csv", folder / "table");  // without an ending, which alone may be wrong
  fs::create_hard_link(folder / "run.csv", folder / "hard");
  fs::create_symlink("probes.toml", folder / "probes");
  const std::vector<std::pair<Words, Words>> reading{
      {{"modes", "tables.toml"}, {"tables.toml", "./tables.toml", "table"}},
      {measured, {"rub.toml", "run.csv", "hard", "probes", "probes.toml"}},
      {with(fit, {"--against", "other.toml"}), {"hard", "run.csv", "probes", "other.toml"}},
      {{"fit", "rub.toml", "--measured", "records.toml", "--probes", "probes.toml", "--free",
        "contact.ring.stiffness"},
       {"records.toml", "hard"}},
      {with(motion, {"--from", "run.h5"}), {"run.h5", "rub.toml"}},
      {with(motion, {"--measure", "probes.toml", "--measured-out", "new.csv"}), {"probes.toml"}},
      {{"plot", "run.h5", "bifurcation", "--with", "run2.h5"}, {"run.h5", "run2.h5"}},
      {{"report", "run.h5", "run2.h5"}, {"run.h5", "run2.h5"}}};
  for (const auto& [words, places] : reading) {
    for (const std::string& place : places) {
      for (const char* option : {"--out", "--json"}) {
        const std::string part = place == "hard" ? "" : place;  // told as the record, or its list
        expect_refused(with(words, {option, place}), part);
        expect_refused(with(words, {"--force", option, place}), part);
      }
    }
  }
  expect_refused({"status", "run.h5", "run2.h5", "--force", "--json", "run2.h5"}, "cannot write");
  expect_refused(
      with(motion, {"--measure", "probes.toml", "--force", "--measured-out", "rub.toml"}),
      "cannot write rub.toml");
  expect_refused({"bench", "tables.toml", "--force", "--svg", "table"}, "--svg would replace it");
  expect_refused({"rerun", "run.h5", "--force", "--out", "run.h5"}, "cannot write run.h5");
}

TEST_F(LostFiles, TwoOutputsOfOneNameAreRefused) {
  fs::create_symlink("nothing.h5", folder / "dangling.h5");
  fs::create_hard_link(folder / "run2.csv", folder / "hard.csv");
  const std::string same = "name the same file";
  const Words recorded = with(motion, {"--measure", "probes.toml", "--force"});
  expect_refused(with(motion, {"--out", "dangling.h5", "--json", "nothing.h5"}), same);
  expect_refused(with(recorded, {"--out", "x.h5", "--measured-out", "./x.h5"}), same);
  expect_refused(with(recorded, {"--json", "hard.csv", "--measured-out", "run2.csv"}), same);
  expect_refused({"bench", "rub.toml", "--svg", "x", "--out", "x"}, same);
  expect_refused({"report", "run.h5", "--out", "x", "--json", "x"}, same);
  // a name that an export makes of --out
  write("rotor.toml", jeffcott);
  fs::create_symlink("x.mtx", folder / "answer");
  const Outcome exported = whirl({"export", "rotor.toml", "--speed", "300rpm", "--format", "mat",
                                  "--out", "x", "--json", "y"});
  EXPECT_EQ(exported.status, 0) << exported.err;
  fs::create_symlink("z.mat", folder / "answer.json");
  expect_refused({"export", "rotor.toml", "--speed", "300rpm", "--format", "mat", "--out", "z",
                  "--json", "answer.json"},
                 "cannot write z.mat: --json names this file, too");
}

// A result tells how it was made; run again, only what its own line names is written.
TEST_F(LostFiles, RunningAgainWritesNoRecordThatTheStoredLineNames) {
  for (const char* file : {"run.csv", "run2.csv"}) fs::remove(folder / file);
  const auto before = files();
  const Outcome again = whirl({"rerun", "run.h5"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(files(), before);
  EXPECT_EQ(whirl({"rerun", "run.h5", "--measured-out", "new.csv"}).status, 2);  // of which probes?
  EXPECT_EQ(
      whirl({"rerun", "run.h5", "--measured-out", "new.csv", "--measure", "probes.toml"}).status,
      0);
  EXPECT_TRUE(fs::exists(folder / "new.csv"));
}

// Options that write are declared to do so; the manual of what a file's line does not do again
// hangs on it.
TEST(Outputs, AreDeclared) {
  for (const Verb& verb : verbs()) {
    for (const OptionSpec& option : options_of(verb)) {
      const bool is_named_so = option.name == "out" || option.name == "json" ||
                               option.name == "svg" || option.name.ends_with("-out");
      EXPECT_EQ(option.writes(), is_named_so) << verb.name << " --" << option.name;
      const bool takes_file = option.value.find("FILE") != std::string_view::npos ||
                              option.value.find(".h5") != std::string_view::npos;
      EXPECT_TRUE(!takes_file || option.use != FileUse::none) << verb.name << " --" << option.name;
    }
  }
}

}  // namespace lost_files_test
}  // namespace whirl::test
