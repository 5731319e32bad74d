// continue: branches that are known, going on after kills, refusing.

#include <cmath>
#include <complex>

#include "libbase/numerics/roots.hpp"
#include "tests/cli/studies.hpp"

namespace whirl::test {
namespace continue_test {

class ContinueStudy : public Studies {};

// At 138.4 rad/s and 64 MN/m, from friction 0.15 down: period 1, 2, 4, as simulations say at 0.15,
// 0.12 and 0.11, and the orbit of period 1 goes on beside them, unstable. Each point is an orbit
// that Newton's method finds at once, with the multipliers of the point.
TEST_F(ContinueStudy, ContinueFollowsPeriodDoublings) {
  const json r =
      result({"continue", stator, "--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6",
              "--over", "contact.ring.friction=0.1:0.15:0.002", "--at", "0.15", "--switch", "1",
              "--out", "branch.h5"});
  EXPECT_EQ(r["parameter"], "contact.ring.friction");
  EXPECT_FALSE(r.contains("probes") || r["points"][0].contains("probe_peak_to_peak_m"));
  ASSERT_EQ(r["branches"].size(), 2u);
  EXPECT_EQ(r["branches"][0]["period_revs"], 1);
  EXPECT_EQ(r["branches"][1]["period_revs"], 2);
  EXPECT_EQ(r["branches"][1]["parent"], 1);
  ASSERT_EQ(r["bifurcations"].size(), 2u);
  for (const int i : {0, 1}) {
    EXPECT_EQ(r["bifurcations"][i]["kind"], "period-doubling");
    EXPECT_NEAR(r["bifurcations"][i]["multiplier"][0], -1.0, 1e-6);
  }
  EXPECT_GT(r["bifurcations"][0]["value"], 0.12);
  EXPECT_LT(r["bifurcations"][1]["value"], 0.12);
  EXPECT_GT(r["bifurcations"][1]["value"], 0.11);
  const auto orbit_at = [&](const std::string& number) {
    return result({"orbit", stator, "--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6",
                   "--from", "branch.h5", "--point", number});
  };
  int unstable = 0;
  for (std::size_t i = 3; i < r["points"].size(); i += 12) {
    const json& p = r["points"][i];
    if (p["stable"].is_null()) continue;
    const json orbit = orbit_at(std::to_string(i + 1));
    EXPECT_EQ(orbit["period_revs"], p["branch"]);
    EXPECT_EQ(orbit["stable"], p["stable"]);
    EXPECT_LE(orbit["steps"], 1);
    EXPECT_NEAR(orbit["floquet"][0][0], p["floquet"][0][0], 1e-5);
    EXPECT_NEAR(orbit["contacts"][0]["duty"], p["duty"][0], 1e-6);
    unstable += p["stable"] == false ? 1 : 0;
  }
  EXPECT_GT(unstable, 0);
  const auto problem = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"orbit", stator, "--speed", "138.4rad/s", "--point"});
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 2);
    return o.err;
  };
  EXPECT_TRUE(has(problem({"4711", "--from", "branch.h5"}), "expected a number from 1 to "));
  EXPECT_TRUE(has(problem({"1"}), "of which branches?"));
  std::size_t of_one = 0;
  for (const json& p : r["points"]) {
    const double value = p["value"];
    if (p["branch"] == 1) {
      ++of_one;
      EXPECT_EQ(p["stable"].get<bool>(), value > r["bifurcations"][0]["value"].get<double>());
    }
    EXPECT_EQ(p["impacts_per_rev"][0], 7.0);
    EXPECT_GT(p["max_normal_n"][0], 0.0);
    EXPECT_GT(p["duty"][0], 0.0);
    EXPECT_GT(p["amplitude_m"], 5e-3);  // the clearance less the sag
    EXPECT_LT(p["amplitude_m"], 8e-3);
    EXPECT_TRUE(p["stable"].is_null() || p["floquet"].size() == 8u);
  }
  EXPECT_GT(of_one, 20u);
  const ResultReader file(folder / "branch.h5");
  EXPECT_EQ(file.number_attribute("/branch", "complete"), 1.0);
  EXPECT_EQ(file.strings("/branch/bifurcation_kind")[1], "period-doubling");
  EXPECT_EQ(file.numbers("/branch/value").size(), r["points"].size());
  // a point of the branch is an orbit
  const json orbit = result({"orbit", stator, "--speed", "138.4rad/s", "--set",
                             "contact.ring.stiffness=64e6", "--set", "contact.ring.friction=0.15"});
  EXPECT_NEAR(orbit["state"][0], file.numbers("/branch/state")[0], 1e-10);
}

// A branch of more than 100 points, with most kinds of bifurcations on the way.
TEST_F(ContinueStudy, ContinueGoesOnAfterKills) {
  kill_and_compare(
      {"continue", stator, "--over", "operation.speed=130:136:0.02rad/s", "--at", "136"}, "/branch",
      2, 5);
}

// The same branch as Fourier series: the doubling within what 40 harmonics leave, the state at
// phase 0 near that of shooting, and the same numbers again after kills.
TEST_F(ContinueStudy, ContinueFollowsSeries) {
  const std::vector<std::string> branch{"continue", stator,
                                        "--speed",  "138.4rad/s",
                                        "--set",    "contact.ring.stiffness=64e6",
                                        "--over",   "contact.ring.friction=0.12:0.15:0.003",
                                        "--at",     "0.15"};
  auto shooting = branch, series = branch;
  shooting.insert(shooting.end(), {"--out", "shot.h5"});
  series.insert(series.end(), {"--method", "harmonic-balance", "--harmonics", "40"});
  const json a = result(shooting);
  auto once = series;
  once.insert(once.end(), {"--out", "series.h5"});
  const json b = result(once);
  EXPECT_EQ(a["method"], "shooting");
  EXPECT_EQ(b["method"], "harmonic-balance");
  EXPECT_EQ(b["harmonics"], 40);
  ASSERT_EQ(b["bifurcations"].size(), 1u);
  EXPECT_EQ(b["bifurcations"][0]["kind"], "period-doubling");
  EXPECT_NEAR(b["bifurcations"][0]["value"], a["bifurcations"][0]["value"], 1e-3);
  EXPECT_NEAR(b["points"][0]["amplitude_m"], a["points"][0]["amplitude_m"], 1e-6);
  EXPECT_EQ(b["points"][0]["impacts_per_rev"][0], 7.0);
  EXPECT_EQ(b["points"][0]["floquet"].size(), 8u);
  const ResultReader shot(folder / "shot.h5"), file(folder / "series.h5");
  EXPECT_EQ(file.number_attribute("/branch", "harmonics"), 40.0);
  for (const std::size_t i : {0u, 1u, 2u, 3u}) {
    EXPECT_NEAR(file.numbers("/branch/state")[i], shot.numbers("/branch/state")[i], 1e-6);
  }
  // a longer one, for kills
  series[7] = "contact.ring.friction=0.135:0.15:0.0003";
  series.back() = "20";
  kill_and_compare(series, "/branch", 2, 3);
}

const std::vector<std::string> circles{"torus",       WHIRL_SOURCE_DIR "/models/two_disk_mac.toml",
                                       "--over",      "operation.speed=4430:4600:10rpm",
                                       "--discard",   "1500",
                                       "--harmonics", "33",
                                       "--most",      "5"};

// The circle of the 3:1 motion of the two-disk rotor, seen from outside.
TEST_F(ContinueStudy, TorusGoesOnAfterKills) {
  kill_and_compare(circles, "/torus", 2, 7);
}

// Stopped it says so, and its file is whole; the same line goes on, another one is refused.
TEST_F(ContinueStudy, TorusGoesOnAfterStops) {
  std::vector<std::string> words = circles;
  words.insert(words.end(), {"--out", "torus.h5"});
  const Outcome stopped = interrupted(words);
  ASSERT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_TRUE(has(stopped.out, "stopped; the same line goes on from there")) << stopped.out;
  EXPECT_EQ(ResultReader(folder / "torus.h5").number_attribute("/torus", "complete"), 0.0);
  const json rest = result(words);
  EXPECT_GT(rest["resumed"], 0);
  EXPECT_LT(rest["resumed"], 5);
  EXPECT_EQ(rest["points"].size(), 5u);
  const json again = result(words);
  EXPECT_EQ(again["resumed"], 5);
  EXPECT_EQ(again["points"], rest["points"]);
  EXPECT_EQ(again["exponents_per_rev"], rest["exponents_per_rev"]);
  words[9] = "6";
  EXPECT_TRUE(has(whirl(words).err, "holds another study"));
  words.emplace_back("--restart");
  EXPECT_EQ(result(words)["resumed"], 0);
}

TEST_F(ContinueStudy, ContinueSaysWhatIsWrong) {
  const auto error = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"continue", stator};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = whirl(all);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_TRUE(has(error({}), "expected one"));
  EXPECT_TRUE(has(error({"--over", "operation.speed=130:140rad/s", "--at", "150"}), "within"));
  EXPECT_TRUE(has(error({"--over", "contact.ring.stiffness=-1:150MN/m"}), "stiffness"));
  EXPECT_TRUE(has(error({"--over", "operation.speed=130:140rad/s", "--harmonics", "9"}),
                  "goes with --method harmonic-balance"));
  EXPECT_TRUE(has(error({"--over", "operation.speed=130:140rad/s", "--method", "harmonic-balance",
                         "--switch", "1"}),
                  "goes with --method shooting only"));
}

// A rotor without gravity goes round a circle of radius e w^2 / |k - m w^2 + i c w|, which touches
// its stator all around at once where that is the clearance: the grazing is found there, and
// crossed both ways.
TEST_F(ContinueStudy, CrossesTheOnsetOfRubOfACircle) {
  write("circle.toml", R"(format = 1
[operation]
speed = 0.5
[[body]]
name = "disk"
mass = 1
spins = true
[[bearing]]
body = "disk"
stiffness = 0.04
damping = 0.1
[[unbalance]]
body = "disk"
offset = 1
[[contact]]
name = "stator"
body = "disk"
clearance = 1.05
stiffness = 1
friction = 0.2
radius = 21
)");
  const auto radius = [](double w) {
    return w * w / std::abs(std::complex<double>(0.04 - w * w, 0.1 * w));
  };
  const double onset = bracketed_root([&](double w) { return radius(w) - 1.05; }, 0.1, 0.18, 1e-12);
  const auto branch = [&](const std::string& at) {
    return result({"continue", "circle.toml", "--over", "operation.speed=0.1:0.25:0.005rad/s",
                   "--at", at, "--most", "200", "--out", "branch.h5", "--restart"});
  };
  for (const std::string at : {"0.1 rad/s", "0.25 rad/s"}) {
    const json r = branch(at);
    std::vector<double> grazings;
    for (const json& b : r["bifurcations"]) {
      if (b["kind"] == "grazing") grazings.push_back(b["value"]);
    }
    ASSERT_EQ(grazings.size(), 1u) << at;
    EXPECT_NEAR(grazings[0], onset, 1e-5) << at;
    const ResultReader file(folder / "branch.h5");
    EXPECT_EQ(file.numbers("/branch/bifurcation_change"),
              std::vector<double>{at == "0.1 rad/s" ? 1.0 : -1.0});
    bool touches = false, is_free = false;
    for (const json& p : r["points"]) {
      touches = touches || p["duty"][0] == 1.0;
      is_free = is_free || p["duty"][0] == 0.0;
    }
    EXPECT_TRUE(touches && is_free) << at;
    EXPECT_EQ(r["branches"][0]["end_kind"], "range") << at << r["branches"];
  }
}

}  // namespace continue_test
}  // namespace whirl::test
