#pragma once
// Runs the built program in a folder of its own.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "libverbs/command/verb.hpp"

namespace whirl::test {

using nlohmann::json;

constexpr double pi = std::numbers::pi;
constexpr double rpm = pi / 30.0;  ///< [rad/s]

/// What a program left behind.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if one ended it
  std::string out, err;

  json tree() const { return json::parse(out); }
};

inline std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// An isotropic rotor of one mass on springs, omega = 100 rad/s, zeta = 0.01, gravity 9.81 m/s^2.
constexpr const char* jeffcott = R"(format = 1
title = "Jeffcott rotor"
gravity = 9.81
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
name = "shaft"
body = "rotor"
stiffness = 2e4
damping = 4
[[unbalance]]
body = "rotor"
offset = "0.1 mm"
)";

/// A heavily damped mass that rubs all around at its resonance: k = 20 kN/m, m = 2 kg, c = 200
/// N.s/m, e = 1 mm, clearance 0.5 mm, contact stiffness 20 kN/m.
constexpr const char* rubbing = R"(format = 1
[operation]
speed = "100 rad/s"
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
name = "shaft"
body = "rotor"
stiffness = 2e4
damping = 200
[[unbalance]]
body = "rotor"
offset = "1 mm"
[[contact]]
name = "ring"
body = "rotor"
clearance = "0.5 mm"
stiffness = 2e4
)";

class Program : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Starts a program in the folder; its output goes to files there.
  pid_t start(const std::string& program, const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    constexpr int how = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, outputs[0].c_str(), how, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, outputs[1].c_str(), how, 0600);
    pid_t child = -1;
    EXPECT_EQ(posix_spawnp(&child, program.c_str(), &actions, nullptr, argv.data(), environ), 0)
        << program;
    posix_spawn_file_actions_destroy(&actions);
    return child;
  }

  Outcome wait(pid_t child) const {
    Outcome outcome;
    int status = 0;
    if (child <= 0 || waitpid(child, &status, 0) != child) return outcome;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = content(outputs[0]);
    outcome.err = content(outputs[1]);
    for (const auto& file : outputs) std::filesystem::remove(file);
    return outcome;
  }

  Outcome whirl(const std::vector<std::string>& arguments) const {
    return wait(start(WHIRL_PROGRAM, arguments));
  }

  /// What it says to standard error but for progress, which slow machines see.
  static std::string remarks_of(const Outcome& outcome) {
    std::istringstream lines(outcome.err);
    std::string remarks;
    for (std::string line; std::getline(lines, line);) {
      const bool is_progress = std::regex_search(line, std::regex("[0-9]:[0-9]{2}( left)?$"));
      if (!is_progress) remarks += line + "\n";
    }
    return remarks;
  }

  /// What a verb writes with --json -.
  json result(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = whirl(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(remarks_of(outcome), "");
    return outcome.tree();
  }

  /// Writes a model into the folder; its name.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return name;
  }

  /// Names of the files in the folder.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// Whether python has h5py.
  bool has_h5py() const { return wait(start(python, {"-c", "import h5py"})).status == 0; }

  /// Whether animations can be drawn here.
  bool can_animate() const {
    return std::filesystem::exists(
               std::filesystem::path(WHIRL_PROGRAM).replace_filename("whirl_render")) &&
           wait(start("sh", {"-c", "command -v xvfb-run && command -v xauth"})).status == 0;
  }

  static constexpr const char* python = "/usr/bin/python3";
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      ("whirl_cli_test_" + std::to_string(::getpid()) + "_" +
       testing::UnitTest::GetInstance()->current_test_info()->name());

 private:
  const std::filesystem::path outputs[2] = {folder.string() + ".out", folder.string() + ".err"};
};

/// Names of the verbs that take any model and nothing else: small ones do not move
/// quasi-periodically, as torus needs, nor have they a shaft, as lateral does, or a control loop,
/// as sensitivity; fit takes a record, balance a file of runs.
inline const std::vector<std::string> model_verbs = [] {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) {
    if (verb.takes != "MODEL") continue;
    if (verb.name == "torus" || verb.name == "lateral") continue;
    if (verb.name == "fit" || verb.name == "balance" || verb.name == "sensitivity") continue;
    names.emplace_back(verb.name);
  }
  return names;
}();

/// The words of a call with options that keep its verb from measuring for long.
inline std::vector<std::string> briefly(std::vector<std::string> words) {
  const std::string verb = words.front();
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  if (verb == "bench") {
    add({"--methods", "dop853,rk4", "--tolerances", "1e-6", "--discard", "2", "--revolutions",
         "2"});
  }
  if (verb == "sweep" || verb == "map" || verb == "basins") {
    add({"--discard", "10", "--revolutions", "5"});
  }
  if (verb == "continue") {
    add({"--over", "bearing.1.damping=200:210", "--points", "3", "--discard", "10"});
  }
  if (verb == "sweep" || verb == "map") add({"--over", "gravity=9,10m/s^2"});
  if (verb == "map") add({"--over", "bearing.1.damping=200,201"});
  if (verb == "basins") add({"--starts", "3"});
  return words;
}

}  // namespace whirl::test
