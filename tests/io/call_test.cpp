// Calls in result files, and as lines for a shell.

#include "libio/results/call.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "libio/results/hdf5.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::call_test {

using Words = std::vector<std::string>;

/// What a shell makes of a line: its words.
Words words_of(const std::string& line) {
  Words words;
  FILE* shell = ::popen(("for w in " + line + "; do printf '%s\\001' \"$w\"; done").c_str(), "r");
  if (!shell) return words;
  std::string word;
  for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) {
    if (c == 1) {
      words.push_back(word);
      word.clear();
    } else {
      word += static_cast<char>(c);
    }
  }
  ::pclose(shell);
  return words;
}

// The proof is the shell's own: what it takes apart are the words that the line was made of.
TEST(Call, AShellTakesItsLineApartIntoItsWords) {
  const Words words{"whirl",
                    "map",
                    "my rotor.toml",
                    "it's.toml",
                    "start.whirl=[{mode=1, amplitude=\"4 mm\"}]",
                    "a$HOME`id`\\b",
                    "*",
                    "?[a-z]",
                    "",
                    "~",
                    "#no comment",
                    "a;b&c|d<e>f(g)",
                    "!x^y{z,w}",
                    "new\nline\ttab",
                    "Läufer",
                    "--set=a.b=2 mm",
                    "'''"};
  EXPECT_EQ(words_of(shell_line(words)), words);
  EXPECT_EQ(shell_word("--over=operation.speed=130:160:2rad/s"),
            "--over=operation.speed=130:160:2rad/s");
}

// --set X and --set=X, --speed X and --speed=X are the same; the last of other options holds.
TEST(Call, WordsOfEarlyVersionsAreTakenApart) {
  const Call call = parse_call({"build/whirl", "sweep", "--set", "a=1 mm", "r.toml", "--speed=90",
                                "--set=b=2", "--over", "a.b=1:2:1", "--fresh", "--discard", "5",
                                "--discard=7", "--out", "x.h5", "--quiet"});
  EXPECT_EQ(call.verb, "sweep");
  EXPECT_EQ(call.file, "r.toml");
  EXPECT_TRUE(call.words.empty());
  EXPECT_EQ(call.sets, (Words{"a=1 mm", "b=2", "operation.speed=90"}));
  EXPECT_EQ(call.options,
            (Words{"--over=a.b=1:2:1", "--discard=7", "--fresh", "--out=x.h5", "--quiet"}));
  EXPECT_EQ(options_without(call.options, {"out", "quiet", "fresh"}),
            (Words{"--over=a.b=1:2:1", "--discard=7"}));
  EXPECT_EQ(options_named(call.options, {"fresh", "discard"}), (Words{"--discard=7", "--fresh"}));
  EXPECT_EQ(parse_call({"whirl", "report", "a.h5", "b.h5"}).words, Words{"b.h5"});
  EXPECT_EQ(parse_call({}).verb, "");
}

using CallFile = test::InResultFolder;

TEST_F(CallFile, HoldsWhatWasWritten) {
  const Call call{.verb = "map",
                  .file = "my rotor.toml",
                  .words = {},
                  .sets = {"a.b=2 mm"},
                  .options = {"--over=x=1,2", "--discard=3"}};
  {
    ResultWriter file(path);
    file.dataset("/arguments", Words{"whirl", "modes", "other.toml"}, {"", "words", {""}});
    write_call(file, call);
    file.commit();
  }
  const Call read = read_call(ResultReader(path));
  EXPECT_EQ(read.verb, call.verb);
  EXPECT_EQ(read.file, call.file);
  EXPECT_EQ(read.words, call.words);
  EXPECT_EQ(read.sets, call.sets);
  EXPECT_EQ(read.options, call.options);
}

TEST_F(CallFile, OfEarlyVersionsIsReadFromTheWords) {
  {
    ResultWriter file(path);
    file.dataset("/arguments", Words{"whirl", "modes", "r.toml", "--set=a=1"}, {"", "words", {""}});
    file.commit();
  }
  const Call read = read_call(ResultReader(path));
  EXPECT_EQ(read.file, "r.toml");
  EXPECT_EQ(read.sets, Words{"a=1"});
}

// What was set is in the model that is stored with it; where its result went does not count again.
TEST(CallWords, AgainAreThoseThatCount) {
  const Call call{.verb = "simulate",
                  .file = "r.toml",
                  .sets = {"a=1"},
                  .options = {"--discard=300", "--out=x.h5", "--force", "--fresh", "--json=-"}};
  EXPECT_EQ(words_again("whirl", call, {"out", "json"}),
            (Words{"whirl", "simulate", "r.toml", "--discard=300", "--fresh"}));
}

}  // namespace whirl::call_test
