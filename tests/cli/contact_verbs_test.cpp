// simulate, identify and classify: JSON keys, closed forms, going on, failing, being stopped.

#include <cmath>
#include <csignal>
#include <thread>

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace contact_verbs_test {

using namespace std::chrono_literals;

class Simulation : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
    write("rub.toml", rubbing);
  }
};

// Free of contact at resonance: r = e / (2 zeta) = 5 mm around the sag m g / k = 0.981 mm, which
// turns backward seen from the rotor; the unbalance response rests there.
TEST_F(Simulation, OfAFreeRotorEndsInItsUnbalanceResponse) {
  const json r = result({"simulate", "rotor.toml", "--speed", "100rad/s", "--discard", "2000",
                         "--revolutions", "64", "--samples", "32"});
  EXPECT_EQ(r["revolutions"], 64);
  EXPECT_EQ(r["contacts"], json::array());
  ASSERT_EQ(r["stations"].size(), 1u);
  const json& s = r["stations"][0];
  EXPECT_TRUE(s["node"].is_null());
  EXPECT_EQ(s["name"], "rotor");
  EXPECT_NEAR(s["max_radius_m"], 5.981e-3, 1e-8);
  ASSERT_GE(s["peaks"].size(), 1u);
  EXPECT_NEAR(s["peaks"][0]["frequency_rpm"], 100.0 / rpm, 1e-3);
  EXPECT_NEAR(s["peaks"][0]["amplitude_m"], 5e-3, 1e-7);
  ASSERT_GE(s["peaks_rotating"].size(), 1u);
  EXPECT_NEAR(s["peaks_rotating"][0]["frequency_rpm"], -100.0 / rpm, 1e-3);
  EXPECT_NEAR(s["peaks_rotating"][0]["amplitude_m"], 0.981e-3, 1e-7);
  const json& cost = r["cost"];
  for (const char* key : {"steps", "evaluations", "events"}) {
    EXPECT_TRUE(cost[key].is_number_integer()) << key;
  }
  EXPECT_GT(cost["steps"], 0);
  EXPECT_EQ(cost["evaluations"], 0);  // collocation, which is exact without contacts
  EXPECT_EQ(cost["events"], 0);
  EXPECT_TRUE(cost["wall_s"].is_number());
}

// Full annular rub: |k r + k_c (r - s) - m Omega^2 r + i c Omega r| = m e Omega^2
TEST_F(Simulation, OfAFullRub) {
  const double m = 2.0, k = 2e4, c = 200.0, e = 1e-3, s = 0.5e-3, kc = 2e4, Omega = 100.0;
  double low = s, high = 10.0 * e;
  while (high - low > 1e-15) {
    const double r = 0.5 * (low + high);
    const double stiff = (k - m * Omega * Omega) * r + kc * (r - s), loss = c * Omega * r;
    (std::hypot(stiff, loss) > m * e * Omega * Omega ? high : low) = r;
  }
  const json r = result({"simulate", "rub.toml", "--revolutions", "16", "--discard", "50"});
  ASSERT_EQ(r["contacts"].size(), 1u);
  const json& contact = r["contacts"][0];
  EXPECT_EQ(contact["name"], "ring");
  EXPECT_EQ(contact["regime"], "permanent");
  EXPECT_NEAR(contact["duty"], 1.0, 1e-12);
  EXPECT_EQ(contact["impacts_per_rev"], 0.0);
  EXPECT_NEAR(contact["max_normal_n"], kc * (low - s), 1e-6 * kc * s);
  EXPECT_EQ(contact["max_tangential_n"], 0.0);
  EXPECT_NEAR(r["stations"][0]["max_radius_m"], low, 1e-6 * low);
  EXPECT_GT(r["cost"]["steps"], 0);
  EXPECT_GT(r["cost"]["evaluations"], r["cost"]["steps"]);
}

TEST_F(Simulation, RegimesOfAContact) {
  const auto contact = [&](const std::vector<std::string>& sets) {
    std::vector<std::string> words{"simulate", "rub.toml",  "--revolutions",
                                   "16",       "--discard", "50"};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    return result(words)["contacts"][0];
  };
  const json none = contact({"contact.ring.clearance=5 mm"});
  EXPECT_EQ(none["regime"], "none");
  EXPECT_EQ(none["duty"], 0.0);
  EXPECT_EQ(none["max_normal_n"], 0.0);
  const json some = contact({"contact.ring.offset=[\"0.8 mm\", 0]"});
  EXPECT_EQ(some["regime"], "intermittent");
  EXPECT_NEAR(some["impacts_per_rev"], 1.0, 0.1);
  const json rough = contact({"contact.ring.friction=0.2", "contact.ring.radius=20 mm"});
  EXPECT_NEAR(rough["max_tangential_n"], 0.2 * rough["max_normal_n"].get<double>(), 1e-6);
}

TEST_F(Simulation, MethodsAgree) {
  const auto radius = [&](const std::string& method) {
    return result({"simulate", "rub.toml", "--revolutions", "4", "--discard", "50", "--method",
                   method})["stations"][0]["max_radius_m"]
        .get<double>();
  };
  EXPECT_NEAR(radius("cvode-adams"), radius("dop853"), 1e-8);
  EXPECT_NEAR(radius("cvode-bdf"), radius("dop853"), 1e-7);
}

TEST_F(Simulation, RecordsWhatIsAskedFor) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const json r = result({"simulate", model, "--revolutions", "8", "--discard", "0", "--samples",
                         "16", "--stations", "ring,2", "--out", "run.h5"});
  ASSERT_EQ(r["stations"].size(), 2u);
  EXPECT_EQ(r["stations"][0]["node"], 7);
  EXPECT_EQ(r["stations"][1]["node"], 2);
  EXPECT_EQ(r["stations"][1]["name"], "");
  const ResultReader file(folder / "run.h5");
  EXPECT_EQ(file.shape("/trajectory/x"), (std::vector<Eigen::Index>{2, 128}));
  const Vec time = file.vector("/trajectory/time");
  EXPECT_EQ(time(0), 0.0);
  EXPECT_NEAR(time(16), 60.0 / 4430.0, 1e-15);
  // left out: contacts, disks and bearings
  EXPECT_EQ(result({"simulate", model, "--revolutions", "2", "--discard", "0"})["stations"].size(),
            5u);
}

// The rotor bounces in 3:1 resonance at 4430 rpm: 2052.8 and 6158.4 rpm, seen from the rotor.
TEST_F(Simulation, Identify) {
  const json r = result({"identify", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--modes", "6"});
  ASSERT_EQ(r["modes"].size(), 6u);
  EXPECT_EQ(r["modes"][0]["number"], 1);
  ASSERT_GE(r["peaks"].size(), 2u);
  for (const json& peak : r["peaks"]) {
    EXPECT_TRUE(peak["frequency_rpm"].is_number());
    EXPECT_GT(peak["amplitude_m"], 0.0);
    ASSERT_EQ(peak["mac"].size(), 6u);
    const std::vector<double> mac = peak["mac"];
    for (const double value : mac) {
      EXPECT_GE(value, 0.0);
      EXPECT_LE(value, 1.0 + 1e-12);
    }
    const auto best = std::max_element(mac.begin(), mac.end()) - mac.begin();
    EXPECT_EQ(peak["mode"], best + 1);
  }
  EXPECT_NEAR(r["peaks"][0]["frequency_rpm"], -1728.4, 0.1);
  EXPECT_EQ(r["peaks"][0]["mode"], 1);
  EXPECT_EQ(r["peaks"][1]["mode"], 2);
  EXPECT_EQ(r["resonance"]["ratio"], json::array({3, 1}));
  EXPECT_LT(r["resonance"]["error"], 1e-4);
  EXPECT_EQ(r["contacts"][0]["regime"], "intermittent");

  // the fourth peak is made of the second and of the speed
  ASSERT_EQ(r["peaks"].size(), 4u);
  for (const int i : {0, 1, 2}) EXPECT_TRUE(r["peaks"][i]["combination"].is_null());
  const json made = r["peaks"][3]["combination"];
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(made[0]["times"], 2);
  EXPECT_EQ(made[0]["frequency_rpm"], r["peaks"][1]["frequency_rpm"]);
  EXPECT_EQ(made[1]["times"], -1);
  EXPECT_NEAR(made[1]["frequency_rpm"], 4430.0, 1e-9);
}

TEST_F(Simulation, IdentifyOfALinearMotionHasNoResonance) {
  const json r = result({"identify", "rub.toml", "--set", "contact.ring.clearance=1"});
  EXPECT_TRUE(r["resonance"].is_null());
  EXPECT_TRUE(r["peaks"].is_array());
}

// ---- going on ----

/// Largest difference of the ends of two motions, relative to the size of the first.
double distance(const std::filesystem::path& a, const std::filesystem::path& b) {
  const ResultReader first(a), second(b);
  double worst = 0.0;
  for (const char* part : {"/trajectory/end_displacement", "/trajectory/end_velocity"}) {
    const Vec x = first.vector(part), y = second.vector(part);
    worst = std::max(worst, (x - y).norm() / x.norm());
  }
  return worst;
}

TEST_F(Simulation, AMotionGoesOnWhereItEnded) {
  constexpr double tolerance = 1e-6;  // steps fall otherwise, and impacts amplify that
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const auto run = [&](int revolutions, const std::string& from, const std::string& out) {
    std::vector<std::string> words{
        "simulate", model, "--discard", "0", "--revolutions", std::to_string(revolutions),
        "--out",    out,   "--quiet"};
    if (!from.empty()) words.insert(words.end(), {"--from", from});
    EXPECT_EQ(whirl(words).status, 0);
  };
  run(20, "", "whole.h5");
  run(8, "", "first.h5");
  run(12, "first.h5", "second.h5");
  EXPECT_LT(distance(folder / "whole.h5", folder / "second.h5"), tolerance);
  EXPECT_GT(distance(folder / "whole.h5", folder / "first.h5"), 0.01);
  // the first sample of the second part is the end of the first
  const ResultReader first(folder / "first.h5"), second(folder / "second.h5");
  const Vec there =
      second.matrix("/trajectory/basis") * second.matrix("/trajectory/coordinates").col(0);
  const Vec end = first.vector("/trajectory/end_displacement");
  EXPECT_LT((there - end).norm(), 1e-12 * end.norm());
  // [start] from = "file" does the same
  EXPECT_EQ(whirl({"simulate", model, "--discard", "0", "--revolutions", "12", "--out", "third.h5",
                   "--quiet", "--set", "start={from=\"file\", file=\"first.h5\"}"})
                .status,
            0);
  EXPECT_EQ(distance(folder / "second.h5", folder / "third.h5"), 0.0);
}

// ---- failing ----

// Friction that always pushes forward feeds the whirl without bound:
//   mu k_c (r - s) > c omega r
constexpr const char* unstable = R"(format = 1
[operation]
speed = 50
[[body]]
name = "rotor"
mass = 1
spins = true
[[bearing]]
body = "rotor"
stiffness = 1e4
[[unbalance]]
body = "rotor"
moment = 1e-3
[[contact]]
name = "ring"
body = "rotor"
clearance = "0.1 mm"
stiffness = 1e5
friction = 2.0
slip = "forward"
)";

TEST_F(Simulation, AMotionWithoutBoundFailsAndLeavesWhatWasComputed) {
  write("unstable.toml", unstable);
  for (const char* verb : {"simulate", "identify"}) {
    SCOPED_TRACE(verb);
    const Outcome outcome = whirl({verb, "unstable.toml", "--discard", "0", "--revolutions", "2000",
                                   "--out", "x.h5", "--json", "x.json"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_TRUE(has(outcome.err, "unstable.toml: failed: ")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "ring"));
    for (std::istringstream lines(outcome.out); lines;) {
      std::string line;
      std::getline(lines, line);
      EXPECT_LT(line.size(), 400u) << line;
    }
    const json r = json::parse(content(folder / "x.json"));
    EXPECT_GT(r["revolutions"], 0);
    EXPECT_LT(r["revolutions"], 2000);
    EXPECT_TRUE(r["failure"].is_string());
    const ResultReader file(folder / "x.h5");
    EXPECT_EQ(file.number_attribute("/trajectory", "revolutions"), r["revolutions"].get<double>());
    EXPECT_EQ(file.string_attribute("/trajectory", "failure"), r["failure"].get<std::string>());
  }
  // it ends in the last good state, from where it fails again
  const Outcome again =
      whirl({"simulate", "unstable.toml", "--from", "x.h5", "--out", "y.h5", "--quiet"});
  EXPECT_EQ(again.status, 3);
  EXPECT_TRUE(has(again.err, "grows without bound")) << again.err;
}

// ---- Ctrl-C ----

class Interrupt : public Simulation {
 protected:
  /// Starts a long run, waits until it is under way, and stops it; its duration after that [s].
  Outcome stopped(const std::vector<std::string>& words, double& seconds) const {
    const pid_t child = start(WHIRL_PROGRAM, words);
    for (int i = 0; i < 600; ++i) {  // its result file is begun before the first step
      std::this_thread::sleep_for(50ms);
      bool has_begun = false;
      for (const std::string& name : files()) has_begun = has_begun || has(name, ".h5.tmp.");
      if (has_begun) break;
    }
    std::this_thread::sleep_for(1s);
    const auto begin = std::chrono::steady_clock::now();
    ::kill(child, SIGINT);
    const Outcome outcome = wait(child);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return outcome;
  }
};

TEST_F(Interrupt, SavesWhatWasComputed) {
  constexpr double patience = 10.0;  // [s], on a busy machine; alone some 0.3 s
  double seconds = 0.0;
  const Outcome outcome =
      stopped({"simulate", "rub.toml", "--discard", "0", "--revolutions", "1000000", "--samples",
               "4", "--out", "run.h5", "--json", "run.json"},
              seconds);
  EXPECT_EQ(outcome.status, 130);
  EXPECT_LT(seconds, patience);
  EXPECT_TRUE(has(outcome.out, "stopped before the end")) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  const json r = json::parse(content(folder / "run.json"));
  const long revolutions = r["revolutions"];
  EXPECT_GT(revolutions, 0);
  EXPECT_LT(revolutions, 1'000'000);
  EXPECT_EQ(files(), (std::vector<std::string>{"rotor.toml", "rub.toml", "run.h5", "run.json"}));
  {
    const ResultReader file(folder / "run.h5");
    EXPECT_EQ(file.shape("/trajectory/time"), (std::vector<Eigen::Index>{4 * revolutions}));
    EXPECT_EQ(file.shape("/trajectory/x"), (std::vector<Eigen::Index>{1, 4 * revolutions}));
  }

  // It goes on without a jump: the steady circle stays one, also if it ended within a revolution.
  const json on = result({"simulate", "rub.toml", "--from", "run.h5", "--discard", "0",
                          "--revolutions", "4", "--out", "on.h5"});
  EXPECT_EQ(on["revolutions"], 4);
  const ResultReader file(folder / "on.h5");
  const Mat x = file.matrix("/trajectory/x"), y = file.matrix("/trajectory/y");
  const Vec radius = (x.array().square() + y.array().square()).sqrt().row(0).transpose();
  EXPECT_LT(radius.maxCoeff() - radius.minCoeff(), 1e-7 * radius.maxCoeff());
}

TEST_F(Interrupt, BeforeTheFirstRecordedRevolution) {
  double seconds = 0.0;
  const Outcome outcome = stopped({"identify", "rub.toml", "--discard", "10000000", "--revolutions",
                                   "4", "--out", "run.h5", "--json", "-"},
                                  seconds);
  EXPECT_EQ(outcome.status, 130);
  const json r = outcome.tree();
  EXPECT_EQ(r["revolutions"], 0);
  EXPECT_EQ(r["peaks"], json::array());
  const ResultReader file(folder / "run.h5");
  EXPECT_EQ(file.vector("/trajectory/end_displacement").size(), 2);
}

TEST_F(Interrupt, InTheTransientOfClassify) {
  double seconds = 0.0;
  const Outcome outcome =
      stopped({"classify", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--speed", "138.4rad/s",
               "--set", "contact.ring.stiffness=64e6", "--set", "contact.ring.friction=0.2",
               "--discard", "10000000", "--out", "kind.h5", "--json",
               "-"},  // chaos, which has no orbit that would end it
              seconds);
  EXPECT_EQ(outcome.status, 130);
  const json r = outcome.tree();
  EXPECT_TRUE(r["motion"].is_null());
  EXPECT_EQ(r["revs"], 0);
  EXPECT_EQ(ResultReader(folder / "kind.h5").vector("/trajectory/end_displacement").size(), 4);
}

// ---- classify -----------------------------------------------------------------------------------

class Classify : public Simulation {};

TEST_F(Classify, TellsAProvenPeriodicMotion) {
  const json r = result({"classify", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml"});
  EXPECT_EQ(r["motion"], "periodic");
  EXPECT_EQ(r["period_revs"], 1);
  EXPECT_EQ(r["is_proven"], true);
  EXPECT_EQ(r["impacts"], 5);
  EXPECT_EQ(r["revs"], 1);
  ASSERT_EQ(r["lyapunov_per_rev"].size(), 8u);
  EXPECT_NEAR(r["lyapunov_per_rev"][0], -2.944044 * 2.0 * pi / 136.0, 1e-7);
  EXPECT_EQ(r["resolution_per_rev"], 0.0);
  EXPECT_LT(r["residual"], 1e-8);
  EXPECT_EQ(r["contacts"][0]["regime"], "intermittent");
  EXPECT_EQ(r["contacts"][0]["impacts_per_rev"], 5.0);
  EXPECT_EQ(r["reduction"]["size"], 4);
}

TEST_F(Classify, ClaimsChaosOnlyAboveItsResolution) {
  const json r = result({"classify", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--speed",
                         "138.4rad/s", "--set", "contact.ring.stiffness=64e6", "--set",
                         "contact.ring.friction=0.2", "--revolutions", "300"});
  EXPECT_EQ(r["motion"], "chaotic");
  EXPECT_TRUE(r["period_revs"].is_null());
  EXPECT_EQ(r["is_proven"], false);
  EXPECT_TRUE(r["residual"].is_null());
  EXPECT_EQ(r["revs"], 300);
  EXPECT_GT(r["lyapunov_per_rev"][0], 10.0 * r["zero_per_rev"].get<double>());
  EXPECT_NEAR(r["zero_per_rev"], (1.0 + std::log(300.0)) / 300.0, 1e-12);
  EXPECT_GT(r["resolution_per_rev"], 2.0 * r["zero_per_rev"].get<double>());
}

// A motion goes on where its kind was told.
TEST_F(Classify, LeavesItsEndToGoOnFrom) {
  const std::string model = WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml";
  ASSERT_EQ(whirl({"classify", model, "--out", "kind.h5", "--quiet"}).status, 0);
  const ResultReader file(folder / "kind.h5");
  EXPECT_EQ(file.string_attribute("/classify", "motion"), "periodic");
  EXPECT_EQ(file.vector("/classify/exponent").size(), 8);
  const json r =
      result({"simulate", model, "--from", "kind.h5", "--discard", "0", "--revolutions", "16"});
  EXPECT_EQ(r["contacts"][0]["impacts_per_rev"], 5.0);
}

// ---- orbit --------------------------------------------------------------------------------------

class OrbitVerb : public Simulation {};

// Reference point P1: Floquet exponents -2.944044 and -3.473444 1/s, twice each.
TEST_F(OrbitVerb, FindsTheOrbitAndItsMultipliers) {
  const std::string model = WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml";
  const json r = result({"orbit", model, "--discard", "50", "--out", "orbit.h5"});
  EXPECT_EQ(r["period_revs"], 1);
  EXPECT_LT(r["residual"], 1e-11);
  EXPECT_LE(r["steps"], 4);
  EXPECT_EQ(r["stable"], true);
  EXPECT_EQ(r["state"].size(), 8u);
  ASSERT_EQ(r["floquet"].size(), 8u);
  for (const int i : {0, 1, 2, 3}) {
    const double size =
        std::hypot(r["floquet"][i][0].get<double>(), r["floquet"][i][1].get<double>());
    EXPECT_NEAR(std::log(size) * 136.0 / (2.0 * pi), i < 2 ? -2.944044 : -3.473444, 1e-6);
  }
  EXPECT_EQ(r["contacts"][0]["impacts_per_rev"], 5.0);

  // from there, nothing is left to be done, nor in two segments
  const json again = result({"orbit", model, "--from", "orbit.h5", "--period", "2"});
  EXPECT_LE(again["steps"], 1);
  EXPECT_EQ(again["shortest_period_revs"], 1);
  EXPECT_NEAR(again["exponents_1_s"][0][0], -2.944044, 1e-6);
  const ResultReader file(folder / "orbit.h5");
  EXPECT_EQ(file.complex_vector("/orbit/multiplier").size(), 8);
  EXPECT_EQ(file.shape("/orbit/displacement")[1], 1);
}

// At 138.4 rad/s, 64 MN/m and friction 0.12 the orbit of period 1 is unstable beside that of
// period 2.
TEST_F(OrbitVerb, FindsAnUnstableOrbit) {
  const std::vector<std::string> point{"orbit",   WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
                                       "--speed", "138.4rad/s",
                                       "--set",   "contact.ring.stiffness=64e6",
                                       "--set",   "contact.ring.friction=0.12"};
  auto two = point;
  two.insert(two.end(), {"--period", "2", "--out", "two.h5"});
  const json stable = result(two);
  EXPECT_EQ(stable["stable"], true);
  EXPECT_EQ(stable["shortest_period_revs"], 2);
  EXPECT_EQ(stable["contacts"][0]["impacts_per_rev"], 7.0);
  auto one = point;
  one.insert(one.end(), {"--from", "two.h5"});
  const json saddle = result(one);
  EXPECT_EQ(saddle["stable"], false);
  EXPECT_LT(saddle["floquet"][0][0], -1.0);  // on its way from a period doubling
  EXPECT_NEAR(saddle["floquet"][0][1], 0.0, 1e-12);
}

// The two-disk rotor bounces quasi-periodically; seen from itself it repeats, and does so from
// there.
TEST_F(OrbitVerb, FindsAnOrbitInTheRotatingFrame) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const json r = result({"orbit", model, "--frame", "rotating", "--out", "orbit.h5"});
  EXPECT_LT(r["residual"], 1e-10);
  EXPECT_EQ(r["stable"], true);
  EXPECT_EQ(r["floquet"].size(), 15u);
  // 2052.8 rpm seen from the rotor, as its spectrum says; the publication prints 2052
  EXPECT_NEAR(4430.0 / r["period_revs"].get<double>(), 2052.81, 0.01);
  const json again = result({"orbit", model, "--frame", "rotating", "--from", "orbit.h5"});
  EXPECT_NEAR(again["period_revs"], r["period_revs"], 1e-8);
  EXPECT_LE(again["steps"], 2);
}

// The same orbit as a Fourier series: stable, five impacts, near to that of shooting by as much as
// it says, and as a start for shooting.
TEST_F(OrbitVerb, FindsTheOrbitByHarmonicBalance) {
  const std::string model = WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml";
  const json r = result({"orbit", model, "--discard", "50", "--method", "harmonic-balance",
                         "--verify", "--out", "series.h5"});
  EXPECT_EQ(r["method"], "harmonic-balance");
  EXPECT_EQ(r["stable"], true);
  EXPECT_EQ(r["contacts"][0]["impacts_per_rev"], 5.0);
  EXPECT_EQ(r["floquet"].size(), 8u);
  const json& h = r["harmonic_balance"];
  EXPECT_EQ(h["harmonics"], h["levels"].back()["harmonics"]);
  EXPECT_LT(h["truncation"], 1e-5);
  EXPECT_LT(h["shooting"]["displacement"], h["truncation"]);
  EXPECT_LT(h["shooting"]["multiplier"], 1e-3);

  // what is stored adds up to the displacements at phase 0
  const ResultReader file(folder / "series.h5");
  const Vec orders = file.vector("/orbit/order");
  EXPECT_EQ(orders(2), 2.0);
  const CMat amplitudes = file.complex_matrix("/orbit/amplitude");
  const Mat displacement = file.matrix("/orbit/displacement");
  EXPECT_LT((amplitudes.real().rowwise().sum() - displacement).norm(), 1e-12);

  const json fixed = result({"orbit", model, "--from", "series.h5", "--method", "harmonic-balance",
                             "--harmonics", "20", "--period", "2"});
  EXPECT_EQ(fixed["harmonic_balance"]["harmonics"], 20);
  EXPECT_EQ(fixed["shortest_period_revs"], 1);
  const json shot = result({"orbit", model, "--from", "series.h5"});
  EXPECT_EQ(shot["method"], "shooting");
  EXPECT_LE(shot["steps"], 3);
}

TEST_F(OrbitVerb, SaysWhatItCannotDo) {
  const std::string model = WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml";
  const Outcome rotating = whirl({"orbit", model, "--frame", "rotating"});  // under gravity
  EXPECT_EQ(rotating.status, 3);
  EXPECT_TRUE(has(rotating.err, "gravity")) << rotating.err;
  const Outcome other = whirl({"orbit", model, "--frame", "bent"});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(has(other.err, "expected stationary or rotating")) << other.err;
  const auto problem = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"orbit", model};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_TRUE(has(problem({"--method", "balance"}), "expected shooting or harmonic-balance"));
  EXPECT_TRUE(has(problem({"--verify"}), "goes with --method harmonic-balance"));
  EXPECT_TRUE(has(problem({"--harmonics", "9"}), "goes with --method harmonic-balance"));
  EXPECT_TRUE(has(problem({"--method", "harmonic-balance", "--frame", "rotating"}),
                  "stationary frame only"));
  EXPECT_TRUE(has(problem({"--method", "harmonic-balance", "--harmonics", "0"}), "--harmonics"));
  EXPECT_TRUE(has(problem({"--method", "harmonic-balance", "--harmonics", "2", "--period", "3"}),
                  "expected 3 to"));
}

}  // namespace contact_verbs_test
}  // namespace whirl::test
