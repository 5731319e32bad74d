// What is there already: nothing is replaced that whirl did not write, and everything that it did.

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace replacing_test {

class Replacing : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
    ASSERT_EQ(whirl({"simulate", "rub.toml", "--revolutions", "8", "--discard", "4", "--out",
                     "r.h5", "--quiet"})
                  .status,
              0);
  }
  const std::string mine = "what somebody wrote\n";
};

/// A command, and a file that it writes.
struct Writing {
  std::vector<std::string> words;
  std::string place;
};

const std::vector<Writing> writings{
    {{"modes", "rub.toml", "--out", "x.h5"}, "x.h5"},
    {{"modes", "rub.toml", "--json", "x.json"}, "x.json"},
    {{"bench", "rub.toml", "--methods", "rk4", "--tolerances", "1e-4", "--discard", "2",
      "--revolutions", "2", "--svg", "x.svg"},
     "x.svg"},
    {{"plot", "r.h5", "orbit"}, "r_orbit.svg"},
    {{"plot", "r.h5", "orbit", "--out", "x.svg"}, "x.svg"},
    {{"report", "r.h5"}, "r.html"},
    {{"export", "r.h5", "--out", "e"}, "e.pvd"},
    {{"export", "r.h5", "--out", "e"}, "e/e_0002.vtp"},
    {{"export", "r.h5", "--format", "xdmf", "--out", "e"}, "e.xdmf"},
    {{"export", "r.h5", "--format", "xdmf", "--out", "e"}, "e_xdmf.h5"},
    {{"export", "r.h5", "--format", "csv", "--out", "e"}, "e_contacts_name.csv"},
    {{"export", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--format", "vtu", "--out", "e",
      "--modes", "1"},
     "e.vtu"},
    {{"schema", "--out", "s.json"}, "s.json"}};

TEST_F(Replacing, WhatOthersWroteStaysUnlessForced) {
  std::filesystem::create_directory(folder / "e");
  for (auto [words, place] : writings) {
    SCOPED_TRACE(words[0] + " " + place);
    write(place, mine);
    const auto before = files();
    const Outcome refused = whirl(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.err, "cannot write " + place + ": ")) << refused.err;
    EXPECT_TRUE(has(refused.err, "would be lost; take another name, or --force")) << refused.err;
    EXPECT_EQ(content(folder / place), mine);
    if (!has(place, ".csv")) {  // other tables may be there by then
      EXPECT_EQ(files(), before);
    }
    words.emplace_back("--force");
    const Outcome forced = whirl(words);
    EXPECT_EQ(forced.status, 0) << forced.err;
    EXPECT_NE(content(folder / place), mine);
    std::filesystem::remove(folder / place);
  }
}

// The same line given again replaces what it wrote itself.
TEST_F(Replacing, OwnFilesAreReplaced) {
  for (const auto& [words, place] : writings) {
    SCOPED_TRACE(words[0] + " " + place);
    for (const int time : {1, 2}) EXPECT_EQ(whirl(words).status, 0) << time;
    EXPECT_TRUE(std::filesystem::exists(folder / place));
  }
}

TEST_F(Replacing, PicturesOfOtherProgramsAreMarkedAsOwn) {
  if (wait(start("sh", {"-c", "command -v rsvg-convert"})).status != 0) {
    GTEST_SKIP() << "no rsvg-convert";
  }
  for (const char* place : {"o.png", "o.pdf", "-o.png"}) {  // a name is no option
    SCOPED_TRACE(place);
    for (int time = 0; time < 2; ++time) {
      const Outcome o = whirl({"plot", "r.h5", "orbit", std::string("--out=") + place});
      EXPECT_EQ(o.status, 0) << o.err;
    }
    const auto size = std::filesystem::file_size(folder / place);
    std::filesystem::resize_file(folder / place, size / 2);  // no longer what whirl wrote
    EXPECT_EQ(whirl({"plot", "r.h5", "orbit", std::string("--out=") + place}).status, 2);
  }
}

// Neither a result nor a model is taken for a picture; what is read is kept even from --force.
TEST_F(Replacing, ResultsAndInputsAreNotLostToPictures) {
  const std::string before = content(folder / "r.h5");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"modes", "rub.toml", "--json", "r.h5"},
        {"report", "r.h5", "--out", "r.h5", "--force"},
        {"modes", "rub.toml", "--out", "rub.toml", "--force"}}) {
    EXPECT_EQ(whirl(words).status, 2) << words[0];
  }
  EXPECT_EQ(content(folder / "r.h5"), before);
  EXPECT_EQ(content(folder / "rub.toml"), rubbing);
}

// ---- running again what a stranger's file holds ----

/// A result file that says it was made by these words.
void forge(const std::filesystem::path& path, const std::vector<std::string>& words) {
  ResultWriter file(path);
  file.attribute("/", "whirl_version", "0.1.0");
  file.attribute("/", "command", "whirl");
  file.dataset("/model", std::vector<std::string>{rubbing}, {"", "model file", {""}});
  file.attribute("/model", "path", "rub.toml");
  file.dataset("/arguments", words, {"", "words of the command line", {""}});
  file.commit();
}

TEST_F(Replacing, RunningAgainWritesNothingButWhatItsOwnLineNames) {
  const std::string there = (folder / "r.h5").string(), place = (folder / "evil").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"whirl", "report", there, "--out", place + ".html"},
        {"whirl", "plot", there, "orbit", "--out=" + place + ".svg"},
        {"whirl", "export", there, "--out", place},
        {"whirl", "modes", "rub.toml", "--json=" + place, "--out", place},
        {"whirl", "bench", "rub.toml", "--methods", "rk4", "--tolerances", "1e-4", "--discard", "2",
         "--revolutions", "2", "--svg", place + ".svg", "--force"}}) {
    SCOPED_TRACE(words[1]);
    std::filesystem::remove(folder / "forged.h5");
    forge(folder / "forged.h5", words);
    const auto before = files();
    const Outcome o = whirl({"rerun", "forged.h5"});
    EXPECT_EQ(files(), before);
    const bool makes_result = words[1] == "modes" || words[1] == "bench";
    EXPECT_EQ(o.status, makes_result ? 0 : 2) << o.err;
  }
}

// What was set before is stored again, so that the file says all of how it was made.
TEST_F(Replacing, RunningAgainKeepsWhatWasSet) {
  ASSERT_EQ(whirl({"modes", "rub.toml", "--set=body.rotor.mass=3 kg", "--speed=90rad/s", "--out",
                   "a.h5", "--quiet"})
                .status,
            0);
  ASSERT_EQ(whirl({"rerun", "a.h5", "--set", "bearing.shaft.damping=100", "--out", "b.h5"}).status,
            0);
  EXPECT_EQ(ResultReader(folder / "b.h5").strings("/call/set"),
            (std::vector<std::string>{"body.rotor.mass=3 kg", "operation.speed=90rad/s",
                                      "bearing.shaft.damping=100"}));
}

}  // namespace replacing_test
}  // namespace whirl::test
