#pragma once
/// What tests of studies share: that they go on where they were.

#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <random>
#include <thread>

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {

inline const std::string stator = WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml";

/// Studies that are stopped, killed and gone on with.
class Studies : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
  }

  /// Whether all numbers of two result files are the same, bit by bit.
  void expect_same(const std::string& a, const std::string& b, const std::string& group) const {
    const ResultReader one(folder / a), other(folder / b);
    const auto names = one.list(group);
    EXPECT_EQ(names, other.list(group));
    for (const std::string& name : names) {
      const std::string path = group + '/' + name;
      ASSERT_EQ(one.kind(path), other.kind(path)) << path;
      if (one.kind(path) == ObjectKind::group) {
        expect_same(a, b, path);
        continue;
      }
      if (one.kind(path) == ObjectKind::complex) {
        const auto numbers = [&](const ResultReader& file) {
          return file.shape(path).size() == 2 ? file.complex_matrix(path)
                                              : CMat(file.complex_vector(path));
        };
        const CMat x = numbers(one), y = numbers(other);
        ASSERT_EQ(x.size(), y.size()) << path;
        const auto bytes = static_cast<std::size_t>(x.size()) * sizeof(Complex);
        EXPECT_EQ(std::memcmp(x.data(), y.data(), bytes), 0) << path;
        continue;
      }
      if (one.kind(path) == ObjectKind::text) {
        EXPECT_EQ(one.strings(path), other.strings(path));
        continue;
      }
      const std::vector<double> x = one.numbers(path), y = other.numbers(path);
      ASSERT_EQ(x.size(), y.size()) << path;
      EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)), 0) << path;
    }
  }

  /// The same of all that two files hold but the calls that made them.
  void expect_same_results(const std::string& a, const std::string& b) const {
    const ResultReader one(folder / a), other(folder / b);
    const auto names = one.list("/");
    EXPECT_EQ(names, other.list("/"));
    for (const std::string& name : names) {
      if (name == "call" || name == "arguments") continue;
      if (one.kind('/' + name) == ObjectKind::group) {
        expect_same(a, b, '/' + name);
      } else if (one.kind('/' + name) == ObjectKind::text) {
        EXPECT_EQ(one.strings('/' + name), other.strings('/' + name)) << name;
      }
    }
  }

  /// Kills a study again and again at random times; once it ends, it starts anew.
  void kill_and_compare(std::vector<std::string> words, const std::string& group, int kills,
                        unsigned seed) {
    for (const char* name : {"whole.h5", "killed.h5"}) std::filesystem::remove(folder / name);
    words.insert(words.end(), {"--out", "whole.h5"});
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(whirl(words).status, 0);
    const double takes =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    words.back() = "killed.h5";
    std::mt19937 random(seed);
    long resumed = 0;
    for (int k = 0; k < kills || resumed == 0;) {
      const pid_t child = start(WHIRL_PROGRAM, words);
      const auto started = std::chrono::steady_clock::now();
      if (k < kills) {
        std::this_thread::sleep_for(std::chrono::duration<double>(
            takes * std::uniform_real_distribution<double>(0.05, 0.9)(random)));
      } else {  // none of these moments was after something had been saved: such a one
        while (!std::filesystem::exists(folder / "killed.h5") && ::kill(child, 0) == 0 &&
               std::chrono::steady_clock::now() - started < std::chrono::seconds(60)) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      }
      ::kill(child, SIGKILL);
      const Outcome outcome = wait(child);
      if (outcome.status == 128 + SIGKILL) {
        ++k;
        ASSERT_LT(k, kills + 20) << "nothing is saved before it ends";
        if (!std::filesystem::exists(folder / "killed.h5")) continue;
        const ResultReader file(folder / "killed.h5");  // whole, at whatever moment
        if (file.number_attribute(group, "complete") != 1.0) {
          ++resumed;
          continue;
        }
      } else {
        ASSERT_EQ(outcome.status, 0) << outcome.err;
      }
      // the study was done, even if the kill came before its process ended: compare, begin again
      expect_same("whole.h5", "killed.h5", group);
      std::filesystem::remove(folder / "killed.h5");
    }
    ASSERT_EQ(whirl(words).status, 0);
    expect_same("whole.h5", "killed.h5", group);
    EXPECT_GT(resumed, 0);
    for (const std::string& name : files()) EXPECT_FALSE(has(name, ".tmp.")) << name;
  }

  /// A study that signals meet, one after the other, as soon as it has saved something.
  Outcome interrupted(const std::vector<std::string>& words,
                      const std::vector<int>& signals = {SIGINT}) const {
    const std::filesystem::path saved = folder / words.back();
    const auto written = [&saved] {
      std::error_code none;
      const auto time = std::filesystem::last_write_time(saved, none);
      return none ? std::filesystem::file_time_type::min() : time;
    };
    const auto before = written();
    const pid_t child = start(WHIRL_PROGRAM, words);
    siginfo_t ended{};
    while (written() == before && ended.si_pid == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
    for (const int signal : signals) {
      ::kill(child, signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return wait(child);
  }

  /// Waits until a program takes a signal itself, which Linux tells.
  static void wait_for_handler(pid_t child, int signal) {
    for (int i = 0; i < 6000; ++i) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      for (std::string line; std::getline(status, line);) {
        if (!line.starts_with("SigCgt:")) continue;
        if (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "nothing takes signal " << signal;
  }
};

}  // namespace whirl::test
