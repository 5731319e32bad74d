// Calls that cannot be: exit status 2, what is wrong on standard error, and nothing written.

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace bad_call_test {

class BadCall : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
  }

  /// Runs a wrong call with places for results; what it says.
  std::string problem(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--out", "x.h5", "--json", "x.json"});
    return problem_of_line(arguments);
  }
  std::string problem_of_line(const std::vector<std::string>& arguments) const {
    const auto before = files();
    const Outcome outcome = whirl(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before);
    return outcome.err;
  }
};

TEST_F(BadCall, VerbsThatDoNotExist) {
  EXPECT_EQ(problem_of_line({"chek", "rotor.toml"}),
            "whirl: there is no verb \"chek\"; did you mean \"check\"?\n");
  EXPECT_EQ(problem_of_line({"rerunn", "x.h5"}),
            "whirl: there is no verb \"rerunn\"; did you mean \"rerun\"?\n");
  EXPECT_EQ(problem_of_line({"--verison"}),
            "whirl: there is no option \"--verison\"; did you mean \"--version\"?\n");
  EXPECT_TRUE(has(problem_of_line({"dance"}), "known are check, import, static, modes, "));
  EXPECT_TRUE(has(problem_of_line({"orbit", "plot", "rotor.toml"}),
                  "a picture is `whirl simulate MODEL --out r.h5`, then `whirl plot r.h5 orbit`"));
}

TEST_F(BadCall, OptionsThatDoNotExist) {
  EXPECT_EQ(problem({"modes", "rotor.toml", "--spead", "3rpm"}),
            "whirl modes: there is no option \"--spead\"; did you mean \"--speed\"?\n"
            "(whirl modes --help shows its options)\n");
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--mode=3"}), "did you mean \"--modes\"?"));
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--revolutions", "3"}),
                  "there is no option \"--revolutions\""));
  EXPECT_TRUE(has(problem({"simulate", "rotor.toml", "--revs", "3"}), "no option \"--revs\""));
}

TEST_F(BadCall, MissingAndSurplusWords) {
  EXPECT_TRUE(has(problem_of_line({"modes"}), "MODEL is required"));
  EXPECT_EQ(problem({"modes", ""}), "whirl modes: the name of the file is empty\n");
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "two.toml"}), "cannot place \"two.toml\""));
  EXPECT_TRUE(has(problem_of_line({"modes", "rotor.toml", "--json"}), "--json"));
  EXPECT_TRUE(has(problem_of_line({"modes", "rotor.toml", "--modes"}), "--modes"));
}

// Known only once the modes are computed, and told with its place all the same.
TEST_F(BadCall, AStartInAModeThatTheRotorLacks) {
  write("start.toml", std::string(jeffcott) +
                          "\n[start]\nfrom = \"rest\"\nwhirl = [\n"
                          "  { mode = 99, amplitude = \"1 mm\" } ]\n");
  const std::string said = problem({"simulate", "start.toml", "--speed", "3000rpm"});
  const std::string before = std::string(jeffcott) + "\n[start]\nfrom = \"rest\"\nwhirl = [\n";
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  EXPECT_TRUE(has(said, "start.toml:" + std::to_string(line) + ":12")) << said;
  EXPECT_TRUE(has(said, "found mode 99, expected a mode from 1 to ")) << said;
}

TEST_F(BadCall, ValuesOfOptions) {
  EXPECT_EQ(problem({"modes", "rotor.toml", "--modes", "x"}),
            "--modes x: expected a whole number from 1 to 10 000\n");
  EXPECT_EQ(problem({"modes", "rotor.toml", "--modes", "0"}),
            "--modes 0: expected a whole number from 1 to 10 000\n");
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--modes", "2.5"}), "--modes 2.5: expected"));
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--threads", "0"}), "--threads 0: expected"));
  EXPECT_EQ(
      problem({"modes", "rotor.toml", "--speed", "3furlong"}),
      "--speed 3furlong: unknown unit \"furlong\" in \"3furlong\", expected a speed (rad/s)\n");
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--speed", "-3rpm"}), "of zero or more"));
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--speed", "3 mm"}), "expected a speed (rad/s)"));
  EXPECT_TRUE(has(problem({"modes", "rotor.toml", "--speed", ""}), "is not a number"));
  EXPECT_TRUE(has(problem({"critical", "rotor.toml", "--order", "0"}), "above zero"));
  const std::vector<std::string> simulate{"simulate", "rotor.toml", "--speed", "100rad/s"};
  const auto with = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> words = simulate;
    words.insert(words.end(), {option, value});
    return problem(words);
  };
  EXPECT_EQ(
      with("--method", "rk5"),
      "--method rk5: unknown method, expected one of taylor, collocation, dop853, cvode-adams, "
      "cvode-bdf, arkode, arkode-dirk, rk4\n");
  EXPECT_EQ(with("--tolerance", "5"), "--tolerance 5: expected a number from 1e-15 to 1e-2\n");
  EXPECT_TRUE(has(with("--revolutions", "0"), "whole number from 1 to 10 million"));
  EXPECT_TRUE(has(with("--discard", "-1"), "whole number from 0 to 10 million"));
  EXPECT_TRUE(has(with("--samples", "2"), "whole number from 4 to 100 000"));
  EXPECT_TRUE(has(with("--revolutions", "10000000"), "record fewer"));
  EXPECT_EQ(with("--stations", "seal"),
            "--stations seal: there is no station \"seal\"; there are shaft, rotor\n");
  EXPECT_TRUE(has(with("--stations", "shaft, seal"), "there is no station \"seal\""));
  EXPECT_TRUE(has(with("--from", "nothing.h5"), "nothing.h5: there is no such file"));
}

TEST_F(BadCall, Ranges) {
  const auto range = [&](const std::string& speeds) {
    return problem({"campbell", "rotor.toml", "--speeds", speeds});
  };
  EXPECT_TRUE(has(range("abc"), "expected first:last or first:last:step, such as 0:8000:50rpm"));
  EXPECT_TRUE(has(range("10:5:1rpm"), "the last value is below the first"));
  EXPECT_TRUE(has(range("0:100:0rpm"), "the step must be positive"));
  EXPECT_TRUE(has(range("0:100:10mm"), "expected a speed (rad/s)"));
  EXPECT_TRUE(has(range("-100:100:10rpm"), "expected speeds of zero or more"));
}

TEST_F(BadCall, WhatIsSetCountsAsIfItStoodInTheFile) {
  const auto set = [&](const std::string& value) {
    return problem({"modes", "rotor.toml", "--set", value});
  };
  EXPECT_EQ(set("bearing.shaft.stifness=3"),
            "--set bearing.shaft.stifness=3: bearing.shaft.stifness: unknown key, did you mean "
            "\"stiffness\"?\n");
  EXPECT_EQ(set("bearing.shaft.stiffness=-3"),
            "--set bearing.shaft.stiffness=-3: bearing.shaft.stiffness: found -3, expected a "
            "stiffness (N/m) of zero or more\n");
  EXPECT_TRUE(has(set("bearing.shft.stiffness=3"), "did you mean \"shaft\"?"));
  EXPECT_TRUE(has(set("bering.shaft.stiffness=3"), "did you mean \"bearing\"?"));
  EXPECT_TRUE(has(set("title"), "expected PATH=VALUE"));
}

// A study sets values as --set does; what is wrong with them is told of what was given.
TEST_F(BadCall, ValuesOfAStudyAreToldUnderOver) {
  EXPECT_EQ(problem({"modes", "rotor.toml", "--over", "bearing.shaft.stiffness=0:5:1kg"}),
            "--over bearing.shaft.stiffness=0:5:1kg: bearing.shaft.stiffness: found \"0 kg\", "
            "expected a stiffness (N/m)\n");
  const std::string both = problem({"modes", "rotor.toml", "--set", "gravity=1kg", "--over",
                                    "operation.speed,-bearing.shaft.damping=1:5:1kg"});
  EXPECT_TRUE(has(both, "--set gravity=1kg: gravity: found")) << both;
  const std::string second =
      problem({"modes", "rotor.toml", "--over", "operation.speed,-bearing.shaft.damping=1:5:1kg"});
  EXPECT_TRUE(has(second,
                  "--over operation.speed,-bearing.shaft.damping=1:5:1kg: "
                  "bearing.shaft.damping: found \"-1 kg\", expected a damping"))
      << second;
}

TEST_F(BadCall, AWrongModelShowsItsLines) {
  write("bad.toml",
        "format = 1\n"
        "[[body]]\n"
        "name = \"Läufer\"\tmass = 1\n");
  EXPECT_EQ(problem({"check", "bad.toml"}),
            "bad.toml:3:17: not TOML: key-value pair: expected a comment or whitespace, saw 'm'\n"
            "    3 | name = \"Läufer\" mass = 1\n"
            "      |                 ^\n");
  write("bad.toml",
        "format = 1\n"
        "[[contact]]\n"
        "name = \"seal\"\n"
        "node = 1\n"
        "clearance = 1\n"
        "stiffness = \"4 MN/mm^2\"\n"
        "frictoin = 0.1\n");
  EXPECT_EQ(
      problem({"check", "bad.toml"}),
      "bad.toml:4:8: contact.seal.node: the model has no shaft and no nodes: name a body "
      "instead\n"
      "    4 | node = 1\n"
      "      |        ^\n"
      "bad.toml:6:13: contact.seal.stiffness: found \"4 MN/mm^2\", expected a stiffness (N/m)\n"
      "    6 | stiffness = \"4 MN/mm^2\"\n"
      "      |             ^\n"
      "bad.toml:7:1: contact.seal.frictoin: unknown key, did you mean \"friction\"?\n"
      "    7 | frictoin = 0.1\n"
      "      | ^\n");
}

TEST_F(BadCall, ALongLineIsShownInPart) {
  write("bad.toml", "format = 1\ntitle = \"" + std::string(1'000'000, 'x') + "\" junk\n");
  const std::string problem_text = problem({"check", "bad.toml"});
  EXPECT_LT(problem_text.size(), 500u);
  EXPECT_TRUE(has(problem_text, "xxx\" junk"));
}

TEST_F(BadCall, FilesThatAreNotThereOrNotModels) {
  EXPECT_EQ(problem({"check", "nothing.toml"}),
            "nothing.toml: cannot read the file: No such file or directory\n");
  EXPECT_TRUE(has(problem({"check", "."}), "this is a directory"));
  write("empty.toml", "");
  EXPECT_TRUE(has(problem({"check", "empty.toml"}), "the file is empty"));
  EXPECT_TRUE(has(problem({"check", WHIRL_PROGRAM}), "this is not a text file"));
  EXPECT_TRUE(has(problem_of_line({"rerun", "rotor.toml"}), "not an HDF5 file"));
  EXPECT_TRUE(has(problem_of_line({"rerun", "nothing.h5"}), "there is no such file"));
  EXPECT_TRUE(has(problem_of_line({"export", "nothing.h5"}), "there is no such file"));
  EXPECT_TRUE(has(problem_of_line({"export", "rotor.toml", "--format", "stlx"}), "unknown format"));
}

TEST_F(BadCall, PlacesThatCannotBeWrittenAreSaidBeforeTheWork) {
  const Outcome json = whirl({"modes", "rotor.toml", "--json", "nowhere/x.json"});
  EXPECT_EQ(json.status, 2);
  EXPECT_EQ(json.out, "");
  EXPECT_TRUE(has(json.err, "cannot write nowhere/x.json: there is no directory nowhere"));
  const Outcome out =
      whirl({"simulate", "rotor.toml", "--speed", "100rad/s", "--out", "nowhere/x.h5"});
  EXPECT_EQ(out.status, 2);
  EXPECT_TRUE(has(out.err, "cannot write nowhere/x.h5: there is no directory nowhere"));
}

// A slip of the pen must not cost the model: results take the place of results only.
TEST_F(BadCall, ResultsReplaceNothingButResults) {
  write("table", "speed, kxx, kyy\n0, 1, 1\n");
  EXPECT_EQ(problem_of_line({"modes", "rotor.toml", "--out", "table"}),
            "whirl: cannot write table: this file is no result of whirl and would be lost; take "
            "another name, or --force to replace it\n");
  EXPECT_TRUE(has(problem_of_line({"modes", "rotor.toml", "--out", "rotor.toml"}), "is the input"));
  for (const char* name : {"rotor.toml", "./rotor.toml"}) {
    EXPECT_TRUE(has(problem_of_line({"modes", "rotor.toml", "--json", name}),
                    "it is the input of this command"));
  }
  EXPECT_TRUE(has(problem_of_line({"modes", "rotor.toml", "--out", "x.h5", "--json", "./x.h5"}),
                  "--out and --json name the same file"));
  EXPECT_EQ(content(folder / "rotor.toml"), jeffcott);
  EXPECT_EQ(content(folder / "table"), "speed, kxx, kyy\n0, 1, 1\n");
}

// Standard output on a full disk.
TEST_F(BadCall, WhatCannotBePrintedIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const std::string line = std::string(WHIRL_PROGRAM) + " modes rotor.toml --json - > /dev/full";
  const Outcome outcome = wait(start("sh", {"-c", line}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "whirl: cannot write to standard output\n");
}

// A result file must not get the number of a stream that is closed, and the end is an exit status:
// an error that cannot be printed ended the process by a signal.
TEST_F(BadCall, ClosedStreamsEndNoProcessAndSpoilNoFile) {
  const std::string program = WHIRL_PROGRAM;
  const auto status = [&](const std::string& line) {
    return wait(start("sh", {"-c", program + " " + line})).status;
  };
  for (const char* closed : {"2>&-", "2>/dev/full", "2>&- >&- <&-"}) {
    EXPECT_GE(status("modes nothing.toml " + std::string(closed)), 2) << closed;
    EXPECT_LE(status("modes nothing.toml " + std::string(closed)), 3) << closed;
  }
  EXPECT_EQ(status("modes rotor.toml --speed 300rpm --out closed.h5 --quiet 0<&- 2>&-"), 0);
  EXPECT_EQ(
      status("simulate rotor.toml --speed 300rpm --discard 0 --revolutions 4 --out run.h5 2>&-"),
      0);
  for (const char* file : {"closed.h5", "run.h5"}) {
    EXPECT_EQ(ResultReader(folder / file).strings("/model").size(), 1u) << file;
  }
}

// Nothing is left to move: said by check and by every verb with the place, not by a signal.
TEST_F(BadCall, AModelInWhichNothingMoves) {
  write("held.toml",
        "format = 1\n[operation]\nspeed = \"3000 rpm\"\n[[body]]\nname = \"rotor\"\nmass = 1\n"
        "[[bearing]]\nbody = \"rotor\"\nrigid = true\n");
  for (const char* verb : {"check", "modes", "static", "campbell", "critical", "simulate"}) {
    std::vector<std::string> line{verb, "held.toml"};
    if (std::string(verb) == "campbell") line.insert(line.end(), {"--speeds", "0:1000:500rpm"});
    const Outcome outcome = whirl(line);
    EXPECT_EQ(outcome.status, 2) << verb;
    EXPECT_TRUE(has(outcome.err, "held.toml:1:1: nothing can move")) << outcome.err;
  }
}

TEST_F(BadCall, AnEarlierResultStaysAsItIs) {
  ASSERT_EQ(whirl({"modes", "rotor.toml", "--out", "x.h5", "--quiet"}).status, 0);
  const std::string before = content(folder / "x.h5");
  EXPECT_EQ(whirl({"modes", "rotor.toml", "--out", "x.h5", "--set", "body.rotor.mass=-1"}).status,
            2);
  EXPECT_EQ(content(folder / "x.h5"), before);
}

TEST_F(BadCall, ASimulationNeedsASpeed) {
  for (const char* verb : {"simulate", "identify"}) {
    const std::string text = problem({verb, "rotor.toml"});
    EXPECT_TRUE(has(text, "operation.speed: missing, expected a speed (rad/s)")) << text;
    EXPECT_TRUE(has(text, "--speed 3000rpm")) << text;
  }
}

TEST_F(BadCall, AFreeRotorHasModesButNoSagAndNoCriticalSpeeds) {
  write("free.toml", R"(format = 1
gravity = 9.81
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "50 mm"
)");
  EXPECT_EQ(
      problem({"static", "free.toml"}),
      "free.toml: the static sag needs supports, but the rotor or a body is free to move: add a "
      "[[bearing]] or a [[link]] that holds it\n");
  EXPECT_TRUE(has(problem({"critical", "free.toml"}), "critical speeds need supports"));
  const json modes = result({"modes", "free.toml"});
  EXPECT_EQ(modes["rigid_body"].size(), 4u);
  EXPECT_GE(modes["modes"].size(), 4u);
}

TEST_F(BadCall, AStartNeedsAMotionThatFits) {
  ASSERT_EQ(whirl({"modes", "rotor.toml", "--out", "modes.h5", "--quiet"}).status, 0);
  EXPECT_TRUE(has(problem({"simulate", "rotor.toml", "--speed", "100rad/s", "--from", "modes.h5"}),
                  "modes.h5: holds no motion to start from"));
  ASSERT_EQ(whirl({"simulate", "rotor.toml", "--speed", "100rad/s", "--revolutions", "2", "--out",
                   "run.h5", "--quiet"})
                .status,
            0);
  EXPECT_TRUE(
      has(problem({"simulate", "rotor.toml", "--speed", "100rad/s", "--from", "run.h5", "--set",
                   "body.rotor.tilts=true", "--set", "body.rotor.diametral_inertia=1", "--set",
                   "bearing.shaft.tilt_stiffness=1"}),
          "the result has 2 degrees of freedom, the model 4: they do not fit"));
}

}  // namespace bad_call_test
}  // namespace whirl::test
