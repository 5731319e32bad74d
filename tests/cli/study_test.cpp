// sweep, map and basins: JSON, motions that are known, going on after a kill, refusing.

#include <cmath>

#include "tests/cli/studies.hpp"
#include "tests/support/sanitizers.hpp"

namespace whirl::test {
namespace study_test {

class Study : public Studies {};

// The rotor in its stator: from permanent contact to bouncing, whatever the contact stiffness.
TEST_F(Study, MapTellsRegimesAndMotions) {
  const json r =
      result({"map", stator, "--over", "operation.speed=151,136rad/s", "--over",
              "contact.ring.stiffness=50,150MN/m", "--discard", "300", "--revolutions", "200"});
  ASSERT_EQ(r["axes"].size(), 2u);
  EXPECT_EQ(r["axes"][0]["parameter"], "operation.speed");
  EXPECT_EQ(r["axes"][0]["unit"], "rad/s");
  EXPECT_EQ(r["axes"][1]["values"], (json{50e6, 150e6}));
  EXPECT_EQ(r["motion"], json::parse(R"([["periodic", "periodic"], ["periodic", "periodic"]])"));
  EXPECT_EQ(r["regime"],
            json::parse(R"([["permanent", "permanent"], ["intermittent", "intermittent"]])"));
  EXPECT_EQ(r["period_revs"][1][1], 1);
  // the largest exponent of P1 is -2.944044 1/s
  EXPECT_NEAR(r["lyapunov_max"][1][1].get<double>() * 136.0 / (2.0 * pi), -2.944044, 1e-6);
}

// Over the planes of the published study period 1 prevails with little friction, and at 0.3
// hyperchaos is common, as is printed. At 0.12, where chaos at 60 % of the points is printed, it is
// rare: most of what is without order is quasi-periodic or has not settled (docs/validation.md). By
// 64 points of each plane.
TEST_F(Study, MapShowsHowFrictionMakesDisorder) {
  const json r =
      result({"map", stator, "--over", "contact.ring.friction=0.095,0.12,0.3", "--over",
              "operation.speed=131:164rad/s", "--over", "contact.ring.stiffness=6:196MN/m",
              "--points", "8", "--discard", "300", "--revolutions", "200"});
  const auto share = [&](std::size_t plane,
                         const std::function<bool(const json&, const json&)>& is) {
    int count = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = 0; j < 8; ++j) {
        count += is(r["motion"][plane][i][j], r["period_revs"][plane][i][j]);
      }
    }
    return count / 64.0;
  };
  const auto has_period_1 = [](const json&, const json& period) { return period == 1; };
  const auto has_no_order = [](const json& motion, const json&) { return motion != "periodic"; };
  const auto is_chaotic = [](const json& motion, const json&) {
    return motion == "chaotic" || motion == "hyperchaotic";
  };
  const auto is_hyperchaotic = [](const json& motion, const json&) {
    return motion == "hyperchaotic";
  };
  EXPECT_GT(share(0, has_period_1), 0.6);
  EXPECT_GT(share(1, has_no_order), 0.45);
  EXPECT_LT(share(1, has_no_order), 0.75);
  EXPECT_LT(share(1, is_chaotic), 0.25);
  EXPECT_LT(share(1, is_hyperchaotic), 0.05);
  EXPECT_GT(share(2, is_hyperchaotic), 0.2);
}

// Two exponents tell every kind, and are those of all eight.
TEST_F(Study, MapOfTwoExponents) {
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> call{"map",           stator,
                                  "--over",        "contact.ring.friction=0.1,0.3",
                                  "--over",        "operation.speed=136,151rad/s",
                                  "--set",         "contact.ring.stiffness=150e6",
                                  "--discard",     "200",
                                  "--revolutions", "100"};
    call.insert(call.end(), more.begin(), more.end());
    return result(call);
  };
  const json all = with({}), two = with({"--lyapunov", "2"});
  for (const char* told : {"motion", "period_revs", "regime", "lyapunov_max"}) {
    EXPECT_EQ(two[told], all[told]) << told;
  }
  EXPECT_EQ(with({"--lyapunov", "2", "--resolution", "0.3"})["motion"], all["motion"]);
  EXPECT_TRUE(
      has(whirl({"map", stator, "--over", "operation.speed=136,151rad/s", "--resolution", "0"}).err,
          "expected a number from 1e-6 to 10"));
}

// The motions that equal steps of the Runge-Kutta method make: (150 rad/s, 100 MN/m, 0.12) is a
// torus, and chaos with 1000 steps a revolution. It is said whose motions these are.
TEST_F(Study, StepsOfRk4MakeChaosOfATorus) {
  const std::vector<std::string> at{"--set", "contact.ring.stiffness=100e6", "--set",
                                    "contact.ring.friction=0.12"};
  std::vector<std::string> line{"classify",  stator, "--speed",       "150rad/s",
                                "--discard", "1000", "--revolutions", "200"};
  line.insert(line.end(), at.begin(), at.end());
  const json torus = result(line);
  EXPECT_EQ(torus["motion"], "quasi-periodic");
  EXPECT_TRUE(torus.value("notes", json::array()).empty());
  line.insert(line.end(), {"--method", "rk4", "--steps", "1000"});
  const json chaos = result(line);
  EXPECT_EQ(chaos["motion"], "chaotic");
  ASSERT_FALSE(chaos.value("notes", json::array()).empty());
  EXPECT_TRUE(has(chaos["notes"].back(), "1000 equal steps of rk4"));

  const json map = result({"map", stator, "--over", "operation.speed=136,150rad/s", "--over",
                           "contact.ring.stiffness=100,150MN/m", "--discard", "200",
                           "--revolutions", "60", "--method", "rk4", "--steps", "300"});
  EXPECT_EQ(map["period_revs"][0][0], 1);  // P1
  ASSERT_FALSE(map.value("notes", json::array()).empty());
  EXPECT_TRUE(has(map["notes"].back(), "300 equal steps of rk4"));

  const auto problem = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"classify", stator};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 2);
    return o.err;
  };
  EXPECT_TRUE(has(problem({"--steps", "500"}), "goes with --method rk4 only"));
  EXPECT_TRUE(has(problem({"--method", "rk4", "--steps", "1000001"}), "from 1 to 1 million"));
  EXPECT_TRUE(has(problem({"--method", "euler"}), "expected taylor or rk4"));
}

// p/n are told of each ring beside the sum of both: 3/4 each at 660 rad/s.
TEST_F(Study, ImpactsAreToldOfEachContact) {
  const std::string films = WHIRL_SOURCE_DIR "/models/two_disk_oil_film.toml";
  const std::vector<std::string> line{"classify",  films, "--speed",       "660rad/s",
                                      "--discard", "200", "--revolutions", "50"};
  const json r = result(line);
  EXPECT_EQ(r["period_revs"], 4);
  EXPECT_EQ(r["impacts"], 6.0);
  EXPECT_EQ(r["revs"], 4);
  EXPECT_EQ(r["impacts_of_contacts"], (json{3.0, 3.0}));
  EXPECT_TRUE(has(whirl(line).out, "6 impacts in 4 revolutions, left ring 3/4, right ring 3/4"));
}

// On oil films the rub begins between 334 and 335 rad/s (an independent program: 334.6), whatever
// the stiffness of the rings and their friction: the orbit grows into them.
TEST_F(Study, MapShowsThatTheOnsetOfRubIsThatOfTheOrbit) {
  const json r = result({"map", WHIRL_SOURCE_DIR "/models/two_disk_oil_film.toml", "--over",
                         "operation.speed=334,335rad/s", "--over",
                         "contact.1.stiffness,contact.2.stiffness=1e7,9e7", "--over",
                         "contact.1.friction,contact.2.friction=0,0.2", "--discard", "300",
                         "--revolutions", "50", "--tolerance", "1e-8"});
  EXPECT_EQ(r["regime"], json::parse(R"([[["none", "none"], ["none", "none"]],
      [["intermittent", "intermittent"], ["intermittent", "intermittent"]]])"));
}

// Three axes make a stack of planes; neither threads nor the way the points lie change a bit.
TEST_F(Study, MapIsTheSameOnAnyThreads) {
  std::vector<std::string> words{"map",           stator,
                                 "--over",        "operation.speed=130:140:0.1rad/s",
                                 "--over",        "contact.ring.friction=0.1,0.2",
                                 "--over",        "contact.ring.stiffness=64e6,150e6",
                                 "--discard",     "100",
                                 "--revolutions", "40",
                                 "--out",         "one.h5",
                                 "--threads",     "1"};
  ASSERT_EQ(whirl(words).status, 0);
  words[words.size() - 3] = "three.h5";
  words.back() = "3";
  ASSERT_EQ(whirl(words).status, 0);
  expect_same("one.h5", "three.h5", "/map");
  EXPECT_EQ(ResultReader(folder / "one.h5").shape("/map/exponent"),
            (std::vector<Eigen::Index>{101, 2, 2, 8}));
}

TEST_F(Study, SweepGoesUpAndDown) {
  const json r =
      result({"sweep", stator, "--over", "operation.speed=131:135:1rad/s", "--out", "sweep.h5"});
  EXPECT_EQ(r["parameter"], "operation.speed");
  ASSERT_EQ(r["values"].size(), 5u);
  ASSERT_EQ(r["up"].size(), 5u);
  ASSERT_EQ(r["down"].size(), 5u);
  EXPECT_EQ(r["down"][0]["value"], 135.0);  // in the order in which it went
  // period 1, 2, 4 with three, four and more impacts, then chaos, then period 1 with five
  const json& up = r["up"];
  EXPECT_EQ(up[0]["motion"], "periodic");
  EXPECT_EQ(up[0]["period_revs"], 1);
  EXPECT_EQ(up[0]["impacts_per_rev"], 3.0);
  EXPECT_EQ(up[1]["period_revs"], 2);
  EXPECT_EQ(up[1]["impacts_per_rev"], 4.0);
  EXPECT_EQ(up[1]["poincare_m"].size(), 2u);
  EXPECT_EQ(up[2]["period_revs"], 4);
  EXPECT_EQ(up[4]["period_revs"], 1);
  EXPECT_EQ(up[4]["impacts_per_rev"], 5.0);

  const ResultReader file(folder / "sweep.h5");
  EXPECT_EQ(file.strings("/sweep/direction"), (std::vector<std::string>{"up", "down"}));
  // at 135 rad/s the largest line turns with the speed; its radius is below the largest distance
  const std::vector<double> orders = file.numbers("/sweep/order");
  const std::vector<double> all = file.numbers("/sweep/spectrum");
  const auto lines = static_cast<std::ptrdiff_t>(orders.size());
  const auto begin = all.begin() + 4 * 2 * lines;  // up, fifth value, first station
  const auto largest = std::max_element(begin, begin + lines);
  EXPECT_EQ(orders[static_cast<std::size_t>(largest - begin)], 1.0);
  EXPECT_LT(*largest, file.numbers("/sweep/max_radius")[8]);
  // the contact takes as much of the time around the stator as its duty says
  const std::vector<double> angles = file.numbers("/sweep/contact_angle");
  double touch = 0.0;
  for (std::size_t i = 4 * 36; i < 5 * 36; ++i) touch += angles[i];
  EXPECT_NEAR(touch, file.numbers("/sweep/duty")[4], 0.03);  // by samples
}

// A rotor that lies on its ring touches it where its sag and the cross-coupling of its springs have
// taken it, x > 0 and y < 0: all the time in the sectors of that quarter.
TEST_F(Study, SweepSaysWhereTheStatorIsTouched) {
  const Outcome o = whirl({"sweep", "rub.toml", "--over", "operation.speed=100:110:10", "--set",
                           "gravity=9.81", "--set", "unbalance.1.offset=0", "--set",
                           "bearing.shaft.stiffness={xx=2e4,yy=2e4,xy=1e4,yx=0}", "--out", "s.h5"});
  ASSERT_EQ(o.status, 0) << o.err;
  const ResultReader file(folder / "s.h5");
  const std::vector<double> angles = file.numbers("/sweep/contact_angle");
  const std::vector<double> middles = file.numbers("/sweep/sector");
  double there = 0.0, elsewhere = 0.0;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    (middles[i] > 1.5 * pi ? there : elsewhere) += angles[i];
  }
  constexpr double rounding = 1e-9;  // of a sum over samples
  EXPECT_NEAR(there, 1.0, rounding);
  EXPECT_EQ(elsewhere, 0.0);
}

// Where a motion ends depends on where it came from: a carried sweep keeps the rub that a rotor
// starting from rest never finds.
TEST_F(Study, SweepCarriesTheStateOrNot) {
  const std::vector<std::string> words{"sweep", stator, "--over", "operation.speed=160:172:2rad/s"};
  const json carried = result(words);
  auto fresh_words = words;
  fresh_words.emplace_back("--fresh");
  const json fresh = result(fresh_words);
  EXPECT_EQ(fresh["down"], json::array());
  EXPECT_EQ(fresh["up"][6]["impacts_per_rev"], 0.0);
  EXPECT_EQ(fresh["up"][0]["period_revs"], carried["up"][0]["period_revs"]);
  const std::vector<double> from_rest = fresh["up"][6]["poincare_m"],
                            from_below = carried["up"][6]["poincare_m"];
  EXPECT_GT(std::abs(from_rest[0] - from_below[0]), 1e-3);
}

// Above the speeds where a rotor at rest begins to rub, those that rub already go on.
TEST_F(Study, BasinsFindsCoexistingMotions) {
  std::vector<std::string> words{"basins", stator, "--speed",   "170rad/s", "--starts",      "16",
                                 "--size", "1",    "--discard", "200",      "--revolutions", "50"};
  const json r = result(words);
  EXPECT_EQ(r["starts"], 16);
  std::map<std::string, double> share;
  for (const json& a : r["attractors"]) {
    share[a["regime"]] += a["share"].get<double>();
    EXPECT_TRUE(a["start"]["number"].is_number_integer());
    EXPECT_EQ(a["start"]["displacement"].size(), 4u);
    if (a["regime"] == "none") {
      EXPECT_EQ(a["motion"], "periodic");
      EXPECT_EQ(a["impacts_per_rev"], 0.0);
    }
  }
  EXPECT_GT(share["none"], 0.0);
  EXPECT_GT(share["permanent"] + share["intermittent"], 0.0);
  const double settled = 1.0 - r["not_settled"]["motions"].get<double>() / 16.0;
  EXPECT_NEAR(share["none"] + share["permanent"] + share["intermittent"], settled, 1e-12);
  EXPECT_EQ(result(words)["attractors"], r["attractors"]);
  words.insert(words.end(), {"--seed", "2"});
  EXPECT_NE(result(words)["attractors"], r["attractors"]);
}

// The rotor of the tutorial at 4430 rpm: one motion without contact, whose transient falls by 0.2 %
// a revolution, and one that bounces, to which the model's own start leads. Neither waits for its
// transient to be taken for one more.
TEST_F(Study, BasinsFindsEveryMotionOnce) {
  write("two_disk.toml", R"(format = 1
[material.steel]
density = "7800 kg/m^3"
youngs_modulus = "211 GPa"
shear_modulus = "81.2 GPa"
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
[[bearing]]
name = "left"
at = "0 mm"
stiffness = "8 MN/m"
damping = "5e3 N.s/m"
[[bearing]]
name = "right"
at = "600 mm"
stiffness = "8 MN/m"
damping = "5e3 N.s/m"
[[disk]]
name = "left disk"
at = "150 mm"
material = "steel"
outer_diameter = "300 mm"
inner_diameter = "20 mm"
width = "10 mm"
unbalance = { offset = "0.5 mm" }
[[disk]]
name = "right disk"
at = "400 mm"
material = "steel"
outer_diameter = "300 mm"
inner_diameter = "20 mm"
width = "10 mm"
[operation]
speed = "4430 rpm"
[[contact]]
name = "ring"
at = "300 mm"
clearance = "5 mm"
stiffness = "4 MN/m"
[reduction]
method = "modal"
modes = 8
[start]
whirl = [ { mode = 1, amplitude = "4 mm" }, { mode = 2, amplitude = "3 mm" } ]
)");
  const json r = result({"basins", "two_disk.toml", "--starts", "8", "--out", "b.h5"});
  EXPECT_EQ(r["not_settled"]["motions"], 0);
  std::map<std::string, int> times;
  for (const json& a : r["attractors"]) {
    ++times[a["regime"]];
    if (a["regime"] == "none") {
      EXPECT_EQ(a["motion"], "periodic");
    }
    if (a["regime"] != "intermittent") continue;
    EXPECT_EQ(a["motion"], "quasi-periodic");
    EXPECT_EQ(a["start"]["number"], 1);
  }
  EXPECT_EQ(times["none"], 1);
  EXPECT_EQ(times["intermittent"], 1);
  EXPECT_EQ(ResultReader(folder / "b.h5").string_attribute("/basins/motion", "words"),
            "equilibrium,periodic,quasi-periodic,chaotic,hyperchaotic,not settled");

  // while it still settles, it is said what would settle it
  const json early =
      result({"classify", "two_disk.toml", "--discard", "50", "--revolutions", "100"});
  EXPECT_EQ(early["motion"], "not settled");
  const long after = early["settles_after_revs"].get<long>();
  EXPECT_GT(after, 150);
  const Outcome text =
      whirl({"classify", "two_disk.toml", "--discard", "50", "--revolutions", "100"});
  EXPECT_TRUE(has(text.out, "--discard " + std::to_string(after))) << text.out;
  const json settled = result(
      {"classify", "two_disk.toml", "--discard", std::to_string(after), "--revolutions", "200"});
  EXPECT_EQ(settled["motion"], "quasi-periodic");
  EXPECT_TRUE(settled["settles_after_revs"].is_null());
}

// Starts from a plane of the model's own start.
TEST_F(Study, BasinsOverAPlane) {
  const json r =
      result({"basins", stator, "--speed", "170rad/s", "--set",
              "start.displaced=[{body=\"rotor\"}]", "--over", "start.displaced.1.x=0,6mm", "--over",
              "start.displaced.1.vy=0,1m/s", "--out", "b.h5"});
  EXPECT_EQ(r["starts"], 4);
  EXPECT_EQ(r["axes"][1]["unit"], "m/s");
  const ResultReader file(folder / "b.h5");
  EXPECT_EQ(file.shape("/basins/attractor"), (std::vector<Eigen::Index>{2, 2}));
  const std::vector<double> x = file.numbers("/basins/start_displacement");
  EXPECT_EQ(x[0], 0.0);
  EXPECT_NEAR(x[2 * 4], 6e-3, 1e-15);
}

TEST_F(Study, MapGoesOnWhereItWasKilled) {
  kill_and_compare({"map", stator, "--over", "operation.speed=130:160:0.5rad/s", "--over",
                    "contact.ring.friction=0:0.3:0.02", "--discard", "40", "--revolutions", "10"},
                   "/map", 7, 1);
}

TEST_F(Study, SweepGoesOnWhereItWasKilled) {
  kill_and_compare({"sweep", stator, "--over", "operation.speed=130:142:0.2rad/s", "--discard",
                    "40", "--revolutions", "20", "--spectra", "4"},
                   "/sweep", 7, 2);
}

TEST_F(Study, BasinsGoesOnWhereItWasKilled) {
  kill_and_compare({"basins", stator, "--set", "contact.ring.stiffness=64e6", "--speed",
                    "138.4rad/s", "--starts", "1500", "--discard", "40", "--revolutions", "20"},
                   "/basins", 6, 3);
}

TEST_F(Study, StopsOnCtrlCAndGoesOn) {
  const std::vector<std::string> words{"map",       stator,
                                       "--over",    "operation.speed=130:160:0.1rad/s",
                                       "--over",    "contact.ring.friction=0:0.3:0.02",
                                       "--discard", "300",
                                       "--out",     "map.h5"};
  const Outcome stopped = interrupted(words);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_TRUE(has(stopped.out, "the same line goes on from there")) << stopped.out;
  const ResultReader file(folder / "map.h5");
  EXPECT_EQ(file.number_attribute("/map", "complete"), 0.0);
  const std::vector<double> done = file.numbers("/map/done");
  EXPECT_GT(std::count(done.begin(), done.end(), 1.0), 0);
}

// 40 points, fewer than go together in one batch: what is done when Ctrl-C comes is kept, and the
// same line goes on from there to the same numbers.
TEST_F(Study, AFewPointsAreKeptOnCtrlCToo) {
  std::vector<std::string> words{"map",           stator,
                                 "--over",        "operation.speed=135:139:1rad/s",
                                 "--over",        "contact.ring.friction=0.14:0.175:0.005",
                                 "--threads",     "1",
                                 "--revolutions", "4000",
                                 "--exponents",   "4000",
                                 "--out",         "map.h5"};
  EXPECT_EQ(interrupted(words).status, 130);
  const json rest = result(words);
  EXPECT_GT(rest["resumed"], 0);
  EXPECT_LT(rest["resumed"], 40);
  words.back() = "whole.h5";
  ASSERT_EQ(whirl(words).status, 0);
  expect_same("whole.h5", "map.h5", "/map");
}

// A scheduler warns by SIGUSR1 or SIGTERM, and may do so several times over: to the job's script,
// to each of its processes, and by mpirun once more.
TEST_F(Study, StopsOnTheSignalsOfSchedulersAndGoesOn) {
  std::vector<std::string> words{"map",           stator,
                                 "--over",        "operation.speed=130:160:0.5rad/s",
                                 "--over",        "contact.ring.friction=0:0.3:0.02",
                                 "--threads",     "1",
                                 "--revolutions", "200",
                                 "--exponents",   "200",
                                 "--out",         "map.h5"};
  constexpr double patience = 10.0;  // [s], on a busy machine; 5 are promised
  for (const std::vector<int>& signals :
       {std::vector{SIGTERM}, std::vector{SIGUSR1}, std::vector{SIGUSR1, SIGTERM, SIGTERM}}) {
    const auto begin = std::chrono::steady_clock::now();
    const Outcome stopped = interrupted(words, signals);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(stopped.status, 130) << signals[0] << ' ' << stopped.err;
    EXPECT_EQ(stopped.err, "");
    EXPECT_TRUE(has(stopped.out, "the same line goes on from there")) << stopped.out;
    EXPECT_LT(taken.count(), patience);
    EXPECT_EQ(ResultReader(folder / "map.h5").number_attribute("/map", "complete"), 0.0);
    EXPECT_EQ(files(), (std::vector<std::string>{"map.h5", "rub.toml"}));
  }
  EXPECT_GT(result(words)["resumed"], 0);
  words.back() = "whole.h5";
  ASSERT_EQ(whirl(words).status, 0);
  expect_same("whole.h5", "map.h5", "/map");
}

// Searches that would take hours: a single start, or the motions at a single speed.
TEST_F(Study, SearchesStopOnTheSignalsOfSchedulers) {
  constexpr double patience = 10.0;  // [s], on a busy machine; 5 are promised
  constexpr std::chrono::milliseconds searches_by_then(is_sanitized ? 15000 : 300);
  const auto stopped = [&](const std::vector<std::string>& words) {
    const pid_t child = start(WHIRL_PROGRAM, words);
    wait_for_handler(child, SIGTERM);
    std::this_thread::sleep_for(searches_by_then);
    const auto begin = std::chrono::steady_clock::now();
    ::kill(child, SIGTERM);
    const Outcome outcome = wait(child);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(taken.count(), patience) << words[0];
    EXPECT_EQ(outcome.status, 130) << words[0] << ' ' << outcome.err;
    return json::parse(content(folder / "stopped.json"));
  };
  const json search = stopped(
      {"orbit", stator, "--starts", "3", "--discard", "10000000", "--json", "stopped.json"});
  EXPECT_EQ(search["starts"], 0);
  EXPECT_EQ(search["without_orbit"], 0);
  const json bouncing =
      stopped({"resonances", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds",
               "4200:4350:10rpm", "--modes", "2", "--confirm", "--starts", "200000", "--json",
               "stopped.json", "--out", "resonances.h5"});
  ASSERT_EQ(bouncing["resonances"].size(), 1u);
  EXPECT_FALSE(bouncing["resonances"][0].contains("bouncing"));  // it is not known
  EXPECT_EQ(ResultReader(folder / "resonances.h5").vector("/resonances/speed").size(), 1);
}

// A study that goes on takes its motions from where they began at first, or not at all.
TEST_F(Study, RefusesToGoOnFromAnotherStart) {
  const auto make_start = [&](const std::string& revolutions) {
    return whirl({"simulate", "rub.toml", "--discard", "0", "--revolutions", revolutions, "--out",
                  "start.h5", "--quiet"})
        .status;
  };
  ASSERT_EQ(make_start("5"), 0);
  std::vector<std::string> words{"map",       "rub.toml",
                                 "--over",    "operation.speed=90,100rad/s",
                                 "--over",    "contact.ring.stiffness=2e4,3e4",
                                 "--discard", "20",
                                 "--from",    "start.h5",
                                 "--out",     "map.h5"};
  ASSERT_EQ(whirl(words).status, 0);
  ASSERT_EQ(make_start("5"), 0);  // the same motion again
  EXPECT_EQ(result(words)["resumed"], 4);
  ASSERT_EQ(make_start("6"), 0);
  const Outcome o = whirl(words);
  EXPECT_EQ(o.status, 2);
  EXPECT_TRUE(has(o.err, "from another start: start.h5 has changed since")) << o.err;
  words.emplace_back("--restart");
  EXPECT_EQ(result(words)["resumed"], 0);
}

// --set X and --set=X are the same line.
TEST_F(Study, GoesOnWhateverWayOptionsAreWritten) {
  const std::vector<std::string> axes{"--over",    "operation.speed=90,100rad/s",
                                      "--over",    "contact.ring.stiffness=2e4,3e4",
                                      "--discard", "20"};
  std::vector<std::string> words{"map",   "rub.toml", "--set", "body.rotor.mass=3 kg",
                                 "--out", "map.h5"};
  words.insert(words.end(), axes.begin(), axes.end());
  ASSERT_EQ(whirl(words).status, 0);
  std::vector<std::string> other{"map", "--out=map.h5", "rub.toml", "--set=body.rotor.mass=3 kg"};
  other.insert(other.end(), axes.begin(), axes.end());
  EXPECT_EQ(result(other)["resumed"], 4);
}

TEST_F(Study, RefusesFilesOfOtherStudies) {
  std::vector<std::string> words{"map",           "rub.toml",
                                 "--over",        "operation.speed=90:100:5rad/s",
                                 "--over",        "contact.ring.stiffness=2e4,3e4",
                                 "--discard",     "20",
                                 "--revolutions", "10",
                                 "--out",         "map.h5"};
  ASSERT_EQ(whirl(words).status, 0);
  EXPECT_EQ(result(words)["resumed"], 6);
  const std::string before = content(folder / "map.h5");
  const auto refused = [&](const std::vector<std::string>& w, const std::string& why) {
    const Outcome o = whirl(w);
    EXPECT_EQ(o.status, 2);
    EXPECT_TRUE(has(o.err, why)) << o.err;
    EXPECT_TRUE(has(o.err, "--restart")) << o.err;
    EXPECT_EQ(content(folder / "map.h5"), before);
  };
  auto longer = words;
  longer[7] = "30";
  refused(longer, "holds another study");
  write("rub.toml", std::string(rubbing) + "# changed\n");
  refused(words, "changed since");
  write("rub.toml", rubbing);
  longer.emplace_back("--restart");
  EXPECT_EQ(whirl(longer).status, 0);
  EXPECT_NE(content(folder / "map.h5"), before);
}

// Cross-coupled springs drive the motion beyond all bounds at some points: they are marked, the
// rest is there.
TEST_F(Study, KeepsGoingWherePointsFail) {
  const json r =
      result({"map", "rub.toml", "--set", "bearing.shaft.stiffness={xx=2e4,yy=2e4,xy=0,yx=-1e6}",
              "--over", "bearing.shaft.stiffness.xy=0,1e6", "--over",
              "contact.ring.clearance=4,5mm", "--discard", "1000"});
  EXPECT_EQ(r["motion"][0][0], "periodic");
  EXPECT_TRUE(r["motion"][1][0].is_null());
  EXPECT_TRUE(has(r["failure"], "2 of 4 points")) << r["failure"];
}

TEST_F(Study, BadInput) {
  const auto says = [&](const std::vector<std::string>& words, const std::string& what) {
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 2) << what;
    EXPECT_TRUE(has(o.err, what)) << o.err;
  };
  says({"sweep", "rub.toml"}, "found 0 of them, expected 1");
  says({"map", "rub.toml", "--over", "operation.speed=1:2:1"}, "found 1 of them, expected 2 to 3");
  says({"sweep", "rub.toml", "--over", "operation.speed=1:2"}, "--points");
  says({"sweep", "rub.toml", "--over", "operation.speed=1:2:1kg"}, "expected a speed");
  says({"sweep", "rub.toml", "--over", "contact.ring.clearance=0:1:0.5mm"}, "clearance");
  says({"sweep", "rub.toml", "--over", "contact.rim.clearance=1:2:1mm"}, "rim");
  says({"basins", "rub.toml", "--over", "operation.speed=90:100:5rad/s"}, "vary the start only");
  says({"basins", "rub.toml", "--set", "start.displaced=[{x=1}]"}, "start.displaced.1");
  says({"basins", "rub.toml", "--set", "start.displaced=[{body=\"rotor\", z=1}]"}, "unknown key");
  says({"sweep", "rub.toml", "--over", "operation.speed=90:100:5rad/s", "--tolerance", "1"},
       "1e-15");
  says({"sweep", "rub.toml", "--over", "operation.speed=90:100:5rad/s", "--sections", "0"},
       "sections");
}

}  // namespace study_test
}  // namespace whirl::test
