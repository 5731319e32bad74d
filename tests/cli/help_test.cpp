// What the program says about itself.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace help_test {

/// Verbs that take a file and options.
std::vector<std::string> all_verbs() {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) {
    if (verb.run.with) names.emplace_back(verb.name);
  }
  return names;
}

/// Of a rig, by which its record is written and read.
constexpr const char* probes = R"([[probe]]
name = "x"
node = 7
angle = 0
[[probe]]
name = "y"
node = 7
angle = "90 deg"
[keyphasor]
channel = "key"
)";

using Help = Program;

TEST_F(Help, OverviewNamesEveryVerbWithAnExample) {
  const Outcome help = whirl({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const std::string& verb : all_verbs()) {
    EXPECT_TRUE(std::regex_search(help.out, std::regex("\n  " + verb + " +[a-z]"))) << verb;
    EXPECT_TRUE(has(help.out, "whirl " + verb + " ")) << verb;
  }
  for (const char* example :
       {"whirl rerun run.h5", "source <(whirl completion)", "whirl schema --out"}) {
    EXPECT_TRUE(has(help.out, example)) << example;
  }
  for (const char* option : {"--set", "--speed", "--out", "--json", "--threads", "--quiet"}) {
    EXPECT_TRUE(has(help.out, option)) << option;
  }
  EXPECT_EQ(whirl({}).out, help.out);
  EXPECT_EQ(whirl({"-h"}).out, help.out);
  EXPECT_EQ(whirl({"help"}).out, help.out);
  for (const char* name : {"docs/command-line.md", "docs/model-file.md"}) {
    EXPECT_TRUE(has(help.out, name));
    EXPECT_TRUE(std::filesystem::exists(std::string(WHIRL_SOURCE_DIR "/") + name)) << name;
  }
}

// The script, run in bash: verbs, options of a verb, file names.
TEST_F(Help, CompletesInBash) {
  write("rotor.toml", "");
  const auto completes = [&](const std::string& line) {
    const Outcome o = wait(
        start("/bin/bash",
              {"-c",
               std::string("source <(\"$0\" completion); COMP_WORDS=(whirl ") + line +
                   "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _whirl; echo \"${COMPREPLY[@]}\"",
               WHIRL_PROGRAM}));
    EXPECT_EQ(o.status, 0) << o.err;
    return o.out;
  };
  EXPECT_EQ(completes("sw"), "sweep\n");
  EXPECT_EQ(completes("sweep rotor.toml --sec"), "--sections\n");
  EXPECT_EQ(completes("sweep rot"), "rotor.toml\n");
  EXPECT_EQ(completes("modes rotor.toml --sec"), "\n");
  EXPECT_EQ(completes("modes rotor.toml --speed ''"), "\n");
  EXPECT_EQ(completes("rer"), "rerun\n");
  EXPECT_EQ(completes("schema --o"), "--out\n");
  EXPECT_EQ(completes("modal"), "modal-content\n");
  EXPECT_EQ(completes("modal-content rotor.toml --meas"), completes("identify rotor.toml --meas"));
  EXPECT_NE(completes("modal-content rotor.toml --meas"), "\n");
  EXPECT_EQ(whirl({"completion", "--shell"}).status, 2);
}

TEST_F(Help, SchemaIsPrintedOrWritten) {
  const Outcome printed = whirl({"schema"});
  EXPECT_EQ(printed.status, 0);
  EXPECT_TRUE(printed.tree()["properties"].contains("contact"));
  const Outcome written = whirl({"schema", "--out", "whirl.schema.json"});
  EXPECT_EQ(written.status, 0);
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(content(folder / "whirl.schema.json"), printed.out);
  EXPECT_TRUE(has(whirl({"schema", "--help"}).out, "Usage: whirl schema"));
  EXPECT_EQ(whirl({"help", "schema"}).out, whirl({"schema", "--help"}).out);
  EXPECT_EQ(whirl({"schema", "rotor.toml"}).status, 2);
  write("taken.json", "not whirl's");
  EXPECT_EQ(whirl({"schema", "--out=taken.json"}).status, 2);
  EXPECT_EQ(whirl({"schema", "--force", "--out=taken.json", "--quiet"}).status, 0);
  EXPECT_EQ(content(folder / "taken.json"), printed.out);
  EXPECT_EQ(whirl({"schema", "--out", "nowhere/x.json"}).status, 2);
}

TEST_F(Help, Version) {
  const Outcome version = whirl({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(std::regex_match(version.out, std::regex("whirl [0-9]+\\.[0-9]+\\.[0-9]+\n")))
      << version.out;
}

TEST_F(Help, EveryVerbExplainsItsOptions) {
  for (const std::string& verb : all_verbs()) {
    SCOPED_TRACE(verb);
    const Outcome help = whirl({verb, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_TRUE(has(help.out, "Example: whirl " + verb));
    for (const char* option :
         {"--set PATH=VALUE", "--speed S", "--out", "--json FILE", "--threads N", "--quiet"}) {
      EXPECT_TRUE(has(help.out, option)) << option;
    }
    EXPECT_EQ(whirl({"help", verb}).out, help.out);
  }
  for (const char* option : {"--revolutions N", "--discard N", "--samples N", "--method M",
                             "--tolerance T", "--from FILE.h5", "--stations NAME,..."}) {
    EXPECT_TRUE(has(whirl({"simulate", "--help"}).out, option)) << option;
    EXPECT_TRUE(has(whirl({"identify", "--help"}).out, option)) << option;
  }
  for (const char* verb : {"modes", "campbell", "identify"}) {
    EXPECT_TRUE(has(whirl({verb, "--help"}).out, "--modes N")) << verb;
  }
}

// Verbs that read their words themselves.
TEST_F(Help, OfOtherVerbsSaysHowTheyAreUsed) {
  for (const Verb& verb : verbs()) {
    if (!verb.run_words) continue;
    const std::string name(verb.name);
    const Outcome help = whirl({name, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_TRUE(help.out.starts_with("Usage: whirl " + name)) << help.out;
    EXPECT_EQ(whirl({"help", name}).out, help.out);
  }
  EXPECT_EQ(whirl({"rerun"}).status, 2);
}

TEST_F(Help, EveryExampleRuns) {
  std::filesystem::create_symlink(WHIRL_SOURCE_DIR "/models", folder / "models");
  write("probes.toml", probes);  // and a record, which the example of fit takes
  ASSERT_EQ(whirl({"simulate", "models/two_disk_mac.toml", "--revolutions", "25", "--measure",
                   "probes.toml", "--measured-out", "run.csv", "--noise", "1%"})
                .status,
            0);
  write("balance.toml",
        "angles = \"with rotation\"\n[[plane]]\nname = \"left\"\nnode = 4\nradius = \"120 mm\"\n"
        "[[probe]]\nname = \"left\"\nnode = 4\nangle = 0\n");
  for (const std::string& verb : all_verbs()) {
    if (verb == "animate" && !can_animate()) continue;
    const std::string help = whirl({verb, "--help"}).out;
    const auto from = help.find("Example: whirl ") + std::string("Example: whirl ").size();
    std::istringstream line(help.substr(from, help.find('\n', from) - from));
    std::vector<std::string> words;
    for (std::string word; line >> word;) words.push_back(word);
    SCOPED_TRACE(testing::PrintToString(words));
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(remarks_of(outcome), "");
    EXPECT_NE(outcome.out, "");
  }
}

}  // namespace help_test
}  // namespace whirl::test
