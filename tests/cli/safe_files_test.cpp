// Files at the edges of a call: at signals, on full disks, beside another call, and where standard
// output takes nothing.

#include <sys/stat.h>

#include "libio/results/hdf5.hpp"
#include "libio/results/row_journal.hpp"
#include "tests/cli/studies.hpp"

namespace whirl::test {
namespace safe_files_test {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

class SafeFiles : public Studies {
 protected:
  void SetUp() override {
    Studies::SetUp();
    write("rotor.toml", std::string(jeffcott) + "[operation]\nspeed = \"300 rpm\"\n");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  }

  /// Starts a call that waits for its model, and waits for the lock of its output as long as a call
  /// can take to its start.
  pid_t start_waiting(const Words& words, const std::string& output) const {
    const pid_t child = start(WHIRL_PROGRAM, words);
    for (int i = 0; i < 1000 && !fs::exists(folder / (output + ".lock")); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return child;
  }
  Outcome shell(const std::string& line) const { return wait(start("sh", {"-c", line})); }
  void expect_nothing_left() const {
    for (const std::string& name : files()) {
      EXPECT_FALSE(has(name, ".tmp.") || name.ends_with(".lock")) << name;
    }
  }
};

// Of two calls with one output the second is refused, before the first has read its model, and the
// first ends as if there were none.
TEST_F(SafeFiles, AnOutputOfAnotherCallIsRefused) {
  const std::string model = content(folder / "rotor.toml");
  for (const auto& [option, name] : {std::pair{"--out", "one.h5"}, {"--json", "one.json"}}) {
    const pid_t first = start_waiting({"modes", "pipe", option, name}, name);
    for (const Words& words :
         {Words{"static", "rotor.toml", option, name},
          {"modes", "rotor.toml", option, std::string("./") + name, "--force"}}) {
      const Outcome second = whirl(words);
      EXPECT_EQ(second.status, 2);
      EXPECT_TRUE(has(second.err, "another run is writing it")) << second.err;
    }
    EXPECT_FALSE(fs::exists(folder / name));
    std::ofstream(folder / "pipe") << model;
    EXPECT_EQ(wait(first).status, 0);
    EXPECT_TRUE(fs::exists(folder / name));
    EXPECT_EQ(whirl({"static", "rotor.toml", option, name}).status, 0);  // and it is free again
  }
  expect_nothing_left();
}

// A signal in the first moments ends a call with its status, and nothing of it stays.
TEST_F(SafeFiles, EarlySignalsLeaveNothingBehind) {
  for (const auto& [signal, status] :
       {std::pair{SIGTERM, 130}, {SIGUSR1, 130}, {SIGINT, 128 + SIGINT}, {SIGHUP, 128 + SIGHUP}}) {
    const pid_t first = start_waiting({"modes", "pipe", "--out", "one.h5"}, "one.h5");
    ::kill(first, signal);
    EXPECT_EQ(wait(first).status, status);
    EXPECT_EQ(files(), (Words{"pipe", "rotor.toml", "rub.toml"})) << signal;
  }
}

// A limit of sizes stands for a full disk: said in words, with the old file whole, and by no
// message of a library.
TEST_F(SafeFiles, AFullDiskCostsNoFile) {
  const std::string program = WHIRL_PROGRAM;
  write("probes.toml", "[[probe]]\nname = \"X\"\nbody = \"rotor\"\nangle = \"0 deg\"\n");
  ASSERT_EQ(whirl({"simulate", "rub.toml", "--discard", "0", "--revolutions", "40", "--quiet",
                   "--measure", "probes.toml", "--out", "run.h5", "--json", "run.json",
                   "--measured-out", "run.csv"})
                .status,
            0);
  ASSERT_EQ(whirl({"report", "run.h5", "--out", "page.html"}).status, 0);
  ASSERT_EQ(whirl({"plot", "run.h5", "orbit", "--out", "orbit.svg"}).status, 0);
  std::map<std::string, std::string> before;
  for (const std::string& file : files()) {
    if (file != "pipe") before[file] = content(folder / file);
  }
  const std::string simulate = " simulate rub.toml --discard 0 --revolutions 41 --quiet --force ",
                    record = simulate + "--measure probes.toml --measured-out run.";
  for (const std::string& line :
       {simulate + "--out run.h5", record + "csv", record + "mat", record + "wav --speed 960rpm",
        record + "uff", std::string(" schema --out run.json --force"),
        std::string(" report run.h5 --out page.html"),
        std::string(" plot run.h5 orbit --out orbit.svg"),
        std::string(" export run.h5 --format csv --out table")}) {
    const Outcome full = shell("ulimit -f 2; exec " + program + line);
    EXPECT_EQ(full.status, 2) << line << full.err;
    EXPECT_TRUE(has(full.err, "ile too large")) << line << full.err;
    EXPECT_FALSE(has(full.err, "HDF5")) << full.err;
    for (const auto& [file, text] : before) {
      EXPECT_TRUE(content(folder / file) == text) << line << file;
    }
    expect_nothing_left();
  }
}

// Whatever is printed to nowhere is told by the status, also what is no answer of a verb.
TEST_F(SafeFiles, WhatStandardOutputDoesNotTakeIsAnError) {
  const std::string program = WHIRL_PROGRAM;
  for (const char* words : {"--help", "", "--version", "help", "modes --help", "merge --help",
                            "help modes", "completion", "schema", "modes rotor.toml",
                            "modes rotor.toml --json -", "rerun", "status nothing.h5 --help"}) {
    for (const char* nowhere : {">/dev/full", ">&-"}) {
      const Outcome o = shell(program + " " + words + " " + nowhere);
      EXPECT_EQ(o.status, 2) << words << nowhere;
      EXPECT_TRUE(has(o.err, "whirl: cannot write to standard output\n"))
          << words << nowhere << o.err;
    }
  }
}

// Options stand anywhere, also behind a list and before the file.
TEST_F(SafeFiles, OptionsStandAnywhereInEveryVerbThatTakesAList) {
  for (const char* file : {"a.h5", "b.h5"}) {
    ASSERT_EQ(whirl({"sweep", "rub.toml", "--over", "gravity=9,10m/s^2", "--discard", "5",
                     "--revolutions", "5", "--out", file})
                  .status,
              0);
  }
  for (const Words& words : std::vector<Words>{
           {"rerun", "--quiet", "a.h5"},
           {"rerun", "--set", "body.rotor.mass=3", "--quiet", "a.h5"},
           {"status", "--json", "s.json", "a.h5", "--quiet", "b.h5"},
           {"report", "--out", "p.html", "a.h5", "--quiet", "b.h5"},
           {"report", "a.h5", "b.h5", "--quiet", "--out=p.html"},
           {"sweep", "--over", "operation.speed=300,400rpm", "rotor.toml", "--quiet", "--discard",
            "5", "--revolutions", "5"},
           {"sweep", "--over=operation.speed=300,400rpm", "--discard", "5", "--quiet", "rotor.toml",
            "--revolutions", "5"},
           {"modes", "--set", "body.rotor.mass=3", "rotor.toml", "--set=gravity=1", "--quiet"},
           {"merge", "--help", "x"},
           {"rerun", "x", "--help"}}) {
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 0) << words[0] << ' ' << words[1] << ": " << o.err;
    if (words.back() != "--help" && words[1] != "--help") {
      EXPECT_EQ(o.out, "") << words[0];
    }
  }
}

// A journal beside an output that is not there yet, of another study: what it has is kept, until
// asked.
TEST_F(SafeFiles, RowsOfAnotherStudyAreKept) {
  RowJournal(folder / "map.h5.rows", "another study")
      .append(std::vector<RowJournal::Row>{{0, "row"}});
  const std::string before = content(folder / "map.h5.rows");
  Words map{"map",           "rub.toml",
            "--over",        "operation.speed=90,100rad/s",
            "--over",        "contact.ring.stiffness=2e4,3e4",
            "--discard",     "5",
            "--revolutions", "5",
            "--out",         "map.h5"};
  const Outcome refused = whirl(map);
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "it has 1 rows of another study")) << refused.err;
  EXPECT_EQ(content(folder / "map.h5.rows"), before);
  EXPECT_FALSE(fs::exists(folder / "map.h5"));
  map.emplace_back("--restart");
  EXPECT_EQ(whirl(map).status, 0);
}

// A stranger's result says by no option and by no line of its model which files are opened here.
TEST_F(SafeFiles, RunningAgainOpensNoFileThatTheResultNames) {
  const Words motion{"simulate", "rub.toml", "--revolutions", "5", "--discard", "0"};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(whirl(with(motion, {"--out", "start.h5"})).status, 0);
  ASSERT_EQ(whirl(with(motion, {"--from", "start.h5", "--out", "from.h5"})).status, 0);
  write("starts.toml", std::string(rubbing) + "[start]\nfrom = \"file\"\nfile = \"start.h5\"\n");
  ASSERT_EQ(whirl({"simulate", "starts.toml", "--revolutions", "5", "--discard", "0", "--out",
                   "starts.h5"})
                .status,
            0);
  fs::rename(folder / "start.h5", folder / "moved.h5");
  ASSERT_EQ(::mkfifo((folder / "start.h5").c_str(), 0600), 0);  // whoever opens it is seen
  for (const char* file : {"from.h5", "starts.h5"}) {
    const Outcome o = whirl({"rerun", file});
    EXPECT_EQ(o.status, 2) << file;
    EXPECT_TRUE(has(o.err, "a result does not say what is opened")) << o.err;
    EXPECT_TRUE(has(o.err, "add --from")) << o.err;
    EXPECT_EQ(whirl({"rerun", file, "--from", "moved.h5"}).status, 0) << file;
  }
  EXPECT_EQ(whirl({"rerun", "starts.h5", "--set", "start.file=moved.h5"}).status, 0);
}

}  // namespace safe_files_test
}  // namespace whirl::test
