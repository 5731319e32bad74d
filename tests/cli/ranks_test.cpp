// whirl-mpi: a study in several processes gives the file that whirl gives, whatever becomes of
// them.

#include <array>
#include <cstdlib>
#include <optional>

#include "libdyn/taylor/batch.hpp"
#include "tests/cli/studies.hpp"

namespace whirl::test {
namespace ranks_cli_test {

const std::vector<std::string> map_words{"map",           stator,
                                         "--over",        "operation.speed=130:140:0.1rad/s",
                                         "--over",        "contact.ring.friction=0.1,0.2",
                                         "--over",        "contact.ring.stiffness=64e6,150e6",
                                         "--discard",     "60",
                                         "--revolutions", "30"};
/// A map of some seconds, of which something is saved soon.
const std::vector<std::string> long_map{"map",           stator,
                                        "--over",        "operation.speed=130:160:0.2rad/s",
                                        "--over",        "contact.ring.friction=0:0.3:0.02",
                                        "--discard",     "60",
                                        "--revolutions", "30",
                                        "--threads",     "1"};

/// Runs of the program in several processes.
class Mpi : public Studies {
 protected:
  void SetUp() override {
    Studies::SetUp();
    if (!std::filesystem::exists(mpirun)) GTEST_SKIP() << "there is no mpirun";
    // as root, with more ranks than processors, without what containers forbid
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe"}) {
      ::setenv(name, "1", 1);
    }
    ::setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
    ::setenv("OMPI_MCA_btl", "self,vader", 1);
  }

  /// The words after mpirun.
  static std::vector<std::string> in_ranks(int count, const std::vector<std::string>& words) {
    std::vector<std::string> all{"-n", std::to_string(count), WHIRL_MPI_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  Outcome whirl_mpi(int count, const std::vector<std::string>& words) const {
    return wait(start(mpirun, in_ranks(count, words)));
  }

  /// Whether a study of any number of ranks and threads finds and writes what whirl does.
  void expect_same_file(const std::vector<std::string>& words, const std::string& group) const {
    const auto with = [&](int threads, const std::string& file) {
      std::vector<std::string> all = words;
      all.insert(all.end(), {"--threads", std::to_string(threads), "--out", file, "--json", "-"});
      return all;
    };
    const Outcome alone = whirl(with(2, "alone.h5"));
    ASSERT_EQ(alone.status, 0) << alone.err;
    for (const int ranks : {1, 2, 4}) {
      for (const int threads : {1, 2}) {
        const Outcome outcome = whirl_mpi(ranks, with(threads, "shared.h5"));
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(outcome.out, alone.out);
        EXPECT_FALSE(ResultReader(folder / "shared.h5").list(group).empty());
        expect_same_results("alone.h5", "shared.h5");
        std::filesystem::remove(folder / "shared.h5");
      }
    }
  }

  /// The process that has started another one; 0: that has ended.
  static pid_t parent_of(pid_t process) {
    const std::string text = content("/proc/" + std::to_string(process) + "/stat");
    if (text.empty()) return 0;
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    char state = ' ';
    pid_t parent = 0;
    rest >> state >> parent;
    return parent;
  }

  /// Processes of the program that a process, or one of its own, has started, in the order of their
  /// ranks.
  static std::vector<pid_t> ranks_of(pid_t parent, std::size_t count) {
    std::vector<pid_t> found;
    while (found.size() < count && ::kill(parent, 0) == 0) {
      found.clear();
      for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (!has(content(entry.path() / "stat"), "(whirl-mpi)")) continue;
        const pid_t process = std::stoi(name), starter = parent_of(process);
        if (starter == parent || parent_of(starter) == parent) found.push_back(process);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  void wait_for_file(const std::string& name, pid_t child) const {
    siginfo_t ended{};
    while (!std::filesystem::exists(folder / name) && ended.si_pid == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
  }

  /// A study of three ranks, one of which gets a signal once something is saved; then the file is
  /// whole, and the same line goes on to the same end.
  /// @param rank  nothing: mpirun gets it
  Outcome signal_a_rank(std::optional<std::size_t> rank, int signal,
                        std::vector<std::string> words = long_map) const {
    words.insert(words.end(), {"--out", "alone.h5"});
    if (!std::filesystem::exists(folder / "alone.h5")) {
      EXPECT_EQ(whirl(words).status, 0);
    }
    words.back() = "shared.h5";
    const pid_t child = start(mpirun, in_ranks(3, words));
    const std::vector<pid_t> ranks = ranks_of(child, 3);
    wait_for_file("shared.h5", child);
    if (ranks.size() == 3) ::kill(rank ? ranks[*rank] : child, signal);
    Outcome outcome = wait(child);
    {
      const ResultReader file(folder / "shared.h5");
      EXPECT_EQ(file.number_attribute("/map", "complete"), 0.0);
      const std::vector<double> done = file.numbers("/map/done");
      EXPECT_GT(std::count(done.begin(), done.end(), 1.0), 0);
    }
    EXPECT_EQ(whirl_mpi(2, words).status, 0);
    expect_same("alone.h5", "shared.h5", "/map");
    std::filesystem::remove(folder / "shared.h5");
    return outcome;
  }

  static constexpr const char* mpirun = WHIRL_MPIRUN;
};

TEST_F(Mpi, MapWritesTheSameFile) {
  expect_same_file(map_words, "/map");
}

TEST_F(Mpi, FreshSweepWritesTheSameFile) {
  expect_same_file({"sweep", stator, "--over", "operation.speed=130:142:0.1rad/s", "--fresh",
                    "--discard", "40", "--revolutions", "20", "--spectra", "4"},
                   "/sweep");
}

TEST_F(Mpi, CarriedSweepWritesTheSameFile) {
  expect_same_file({"sweep", stator, "--over", "operation.speed=130:142:0.2rad/s", "--discard",
                    "40", "--revolutions", "20", "--spectra", "4"},
                   "/sweep");
}

TEST_F(Mpi, BasinsWriteTheSameFile) {
  expect_same_file({"basins", stator, "--set", "contact.ring.stiffness=64e6", "--speed",
                    "138.4rad/s", "--starts", "200", "--discard", "40", "--revolutions", "20"},
                   "/basins");
}

TEST_F(Mpi, BranchesAreTheSame) {
  expect_same_file(
      {"continue", stator, "--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6",
       "--over", "contact.ring.friction=0.08:0.18:0.0005", "--at", "0.13", "--switch", "2"},
      "/branch");
}

TEST_F(Mpi, BifurcationCurvesAreTheSame) {
  expect_same_file({"continue", stator, "--speed", "138.4rad/s", "--set",
                    "contact.ring.stiffness=64e6", "--over", "contact.ring.friction=0.1:0.15:0.001",
                    "--at", "0.13", "--over", "contact.ring.stiffness=63.5:64.5:0.5MN/m"},
                   "/border");
}

TEST_F(Mpi, OrbitsNearRandomStartsAreTheSame) {
  expect_same_file(
      {"orbit", stator, "--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6", "--set",
       "contact.ring.friction=0.11", "--starts", "30", "--size", "1"},
      "/trajectory");
}

TEST_F(Mpi, BouncingMotionsAreTheSame) {
  expect_same_file({"resonances", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds",
                    "3000:6000:100rpm", "--modes", "3", "--confirm", "--starts", "4"},
                   "/resonances");
}

// As it was made, by whatever program; with other sets of values, and where nothing is shared.
TEST_F(Mpi, RerunSharesItsWorkToo) {
  auto words = map_words;
  words.insert(words.end(), {"--out", "alone.h5"});
  ASSERT_EQ(whirl(words).status, 0);
  ASSERT_EQ(whirl_mpi(3, {"rerun", "alone.h5", "--out", "shared.h5"}).status, 0);
  expect_same_results("alone.h5", "shared.h5");
  const std::vector<std::string> set{"--set", "contact.ring.friction=0.05"};
  std::vector<std::string> again{"rerun", "shared.h5", "--out", "again.h5", set[0], set[1]};
  ASSERT_EQ(whirl(again).status, 0);
  again[3] = "again_shared.h5";
  ASSERT_EQ(whirl_mpi(2, again).status, 0);
  expect_same_results("again.h5", "again_shared.h5");
  const Outcome missing = whirl_mpi(2, {"rerun", "none.h5"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_TRUE(has(missing.err, "none.h5")) << missing.err;

  ASSERT_EQ(whirl({"modes", "rub.toml", "--out", "modes.h5"}).status, 0);
  const Outcome modes = whirl_mpi(2, {"rerun", "modes.h5", "--json", "-"});
  EXPECT_EQ(modes.status, 0) << modes.err;
  EXPECT_EQ(modes.out, whirl({"rerun", "modes.h5", "--json", "-"}).out);
}

// The arithmetic of a result counts, and is not to be had any more once the processes have agreed.
TEST_F(Mpi, RerunAsksForTheArithmeticOfItsResult) {
  auto words = map_words;
  words.insert(words.end(), {"--out", "alone.h5", "--isa", "baseline"});
  ASSERT_EQ(whirl(words).status, 0);
  if (instruction_sets().size() > 1) {
    const Outcome refused = whirl_mpi(2, {"rerun", "alone.h5", "--out", "shared.h5"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.err, "--isa baseline")) << refused.err;
  }
  ASSERT_EQ(whirl_mpi(2, {"rerun", "alone.h5", "--out", "shared.h5", "--isa", "baseline"}).status,
            0);
  expect_same_results("alone.h5", "shared.h5");
}

// On a disk of its own that is too small for two files of the whole study, one after the other.
TEST_F(Mpi, OnAFullDiskTheLastFileStays) {
  std::vector<std::string> words = long_map;
  words.insert(words.end(), {"--out", "alone.h5"});
  ASSERT_EQ(whirl(words).status, 0);
  words.back() = "small/shared.h5";
  std::string line = std::string(mpirun);
  for (const std::string& word : in_ranks(2, words)) line += " '" + word + "'";
  const auto size = std::filesystem::file_size(folder / "alone.h5");
  write("run.sh", "mkdir small && mount -t tmpfs -o size=" + std::to_string(size * 5 / 4) +
                      " none small || exit 77\n" + line +
                      "\nstatus=$?\nls small\ncp small/shared.h5 .\nexit $status\n");
  const Outcome outcome =
      wait(start("unshare", {"--user", "--map-root-user", "--mount", "sh", "run.sh"}));
  if (outcome.status == 77 || has(outcome.err, "unshare")) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "small/shared.h5") && has(outcome.err, "No space left on device"))
      << outcome.err;
  EXPECT_TRUE(has(outcome.out, "shared.h5\n") && !has(outcome.out, ".tmp.")) << outcome.out;
  {
    const ResultReader file(folder / "shared.h5");
    EXPECT_EQ(file.number_attribute("/map", "complete"), 0.0);
  }
  words.back() = "shared.h5";
  ASSERT_EQ(whirl_mpi(2, words).status, 0);
  expect_same_results("alone.h5", "shared.h5");
}

// Only the leader reads: the model, what was set, and the end that all motions go on from.
TEST_F(Mpi, OthersNeedNoFiles) {
  ASSERT_EQ(whirl({"simulate", "rub.toml", "--revolutions", "7", "--out", "run.h5"}).status, 0);
  const std::vector<std::string> words{"basins",        "rub.toml",
                                       "--from",        "run.h5",
                                       "--starts",      "60",
                                       "--discard",     "20",
                                       "--threads",     "1",
                                       "--revolutions", "10",
                                       "--set",         "contact.ring.stiffness=3e4"};
  auto alone = words, shared = words;
  alone.insert(alone.end(), {"--out", "alone.h5"});
  shared.insert(shared.end(), {"--out", "shared.h5"});
  ASSERT_EQ(whirl(alone).status, 0);
  std::filesystem::create_directories(folder / "empty");
  std::vector<std::string> line{"-n", "1", WHIRL_MPI_PROGRAM};
  line.insert(line.end(), shared.begin(), shared.end());
  line.insert(line.end(), {":", "-n", "2", "-wdir", (folder / "empty").string(), WHIRL_MPI_PROGRAM,
                           "no", "words", "count"});
  const Outcome outcome = wait(start(mpirun, line));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_same("alone.h5", "shared.h5", "/basins");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "empty"));
}

// What is wrong is told once, and what is found is printed once, also by verbs that share nothing.
TEST_F(Mpi, SpeaksOnce) {
  const Outcome modes = whirl_mpi(2, {"modes", "rub.toml"});
  EXPECT_EQ(modes.status, 0) << modes.err;
  EXPECT_EQ(modes.out, whirl({"modes", "rub.toml"}).out);
  const std::vector<std::string> wrong{"map",    stator,
                                       "--over", "operation.speed=130:140:0.1rad/s",
                                       "--over", "contact.ring.friktion=0.1,0.2"};
  const Outcome refused = whirl_mpi(2, wrong);
  EXPECT_EQ(refused.status, 2);
  const std::string told = whirl(wrong).err;
  EXPECT_EQ(refused.err.substr(0, told.size()), told);
  EXPECT_EQ(refused.err.find("friktion", told.size()), std::string::npos) << refused.err;
  std::vector<std::string> words = map_words;
  words.insert(words.end(), {"--json", "-"});
  const Outcome json = whirl_mpi(2, words);
  EXPECT_EQ(json.status, 0) << json.err;
  EXPECT_EQ(json.out, whirl(words).out);
}

TEST_F(Mpi, ALostRankLosesNothingSaved) {
  const Outcome outcome = signal_a_rank(2, SIGKILL);
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.err, "");
}

TEST_F(Mpi, ALostLeaderLosesNothingSaved) {
  EXPECT_NE(signal_a_rank(0, SIGKILL).status, 0);
}

TEST_F(Mpi, WhoeverIsInterruptedStopsAll) {
  for (const auto& [rank, signal] : {std::pair{0u, SIGINT}, {1u, SIGTERM}, {2u, SIGUSR1}}) {
    const Outcome outcome = signal_a_rank(rank, signal);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "the same line goes on from there")) << outcome.out;
  }
}

// As a scheduler does it, and a terminal. Open MPI's mpirun takes a second or two for that.
TEST_F(Mpi, MpirunHandsOnThatItIsToEnd) {
  std::vector<std::string> longer = long_map;
  longer[3] = "operation.speed=130:160:0.05rad/s";
  for (const int signal : {SIGTERM, SIGINT}) {
    const Outcome outcome = signal_a_rank(std::nullopt, signal, longer);
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(has(outcome.out, "the same line goes on from there")) << outcome.out << outcome.err;
  }
}

// The best that all have, and never what differs: each rank may have its own --isa.
TEST_F(Mpi, RanksAgreeOnTheirArithmetic) {
  const auto asks = [](std::vector<std::string> words, const std::string& set) {
    words.insert(words.end(), {"--threads", "1", "--out", "shared.h5", "--isa", set});
    return words;
  };
  const auto set_of = [this](const char* file) {
    return ResultReader(folder / file).string_attribute("/", "instruction_set");
  };
  const std::vector<std::string> sets = instruction_sets();
  std::vector<std::string> alone = asks(map_words, sets.front());
  alone[alone.size() - 3] = "alone.h5";
  ASSERT_EQ(whirl(alone).status, 0);
  if (sets.size() > 2) {  // the first two round alike
    std::vector<std::string> line = in_ranks(1, asks(map_words, sets[0]));
    line.push_back(":");
    const std::vector<std::string> other = in_ranks(1, asks(map_words, sets[1]));
    line.insert(line.end(), other.begin(), other.end());
    const Outcome outcome = wait(start(mpirun, line));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(set_of("shared.h5"), sets[1]);
    expect_same("alone.h5", "shared.h5", "/map");
    std::filesystem::remove(folder / "shared.h5");
  }
  alone.back() = "baseline";
  alone.emplace_back("--restart");
  ASSERT_EQ(whirl(alone).status, 0);
  ASSERT_EQ(whirl_mpi(2, asks(map_words, "baseline")).status, 0);
  EXPECT_EQ(set_of("shared.h5"), "baseline");
  expect_same("alone.h5", "shared.h5", "/map");
  const Outcome unknown = whirl_mpi(2, asks(map_words, "abacus"));
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(has(unknown.err, "--isa")) << unknown.err;
}

/// Names of the libraries that a program needs.
class Linked : public Program {};

TEST_F(Linked, WhirlKnowsNoMpi) {
  const Outcome linked = wait(start("ldd", {WHIRL_PROGRAM}));
  ASSERT_EQ(linked.status, 0) << linked.err;
  EXPECT_TRUE(has(linked.out, "libhdf5")) << linked.out;
  for (const char* library : {"libmpi", "libmpich", "libopen-rte", "libpmi"}) {
    EXPECT_FALSE(has(linked.out, library)) << linked.out;
  }
}

}  // namespace ranks_cli_test
}  // namespace whirl::test
