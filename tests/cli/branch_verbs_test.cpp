// The command line: branches of orbits in the rotating frame, and where they are born.

#include <fmt/format.h>

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::branch_verbs_test {

using namespace test;

class Branches : public Program {
 protected:
  const std::string two_disk = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
};

// The 3:1 bouncing motion of the two-disk rotor at 4430 rpm lives on a closed branch between two
// folds. Its first forward and first backward mode are in resonance somewhat below the lower one,
// as the contact stiffens the rotor.
TEST_F(Branches, OfBouncingBeginAboveTheInternalResonance) {
  const json branch = result({"continue", two_disk, "--frame", "rotating", "--over",
                              "operation.speed=3000:7000:20rpm", "--at", "4430rpm"});
  ASSERT_EQ(branch["branches"].size(), 1u);
  EXPECT_EQ(branch["branches"][0]["end"], "it closes: the first orbit again");
  EXPECT_EQ(branch["branches"][0]["end_kind"], "closed");
  std::vector<double> folds;
  for (const json& b : branch["bifurcations"]) {
    if (b["kind"] == "fold") folds.push_back(b["value"].get<double>() / test::rpm);
  }
  std::sort(folds.begin(), folds.end());
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_LT(folds[0], 4430.0);
  EXPECT_GT(folds[1], 4430.0);
  int stable = 0;
  for (const json& p : branch["points"]) {
    stable += p["stable"].get<bool>() ? 1 : 0;
    EXPECT_NEAR(p["period_revs"].get<double>(), 2.157, 0.002);
  }
  EXPECT_GT(stable, 10);

  const json predicted = result({"resonances", two_disk, "--speeds", "4200:4350:10rpm", "--modes",
                                 "2", "--confirm", "--out", "resonances.h5"})["resonances"];
  ASSERT_EQ(predicted.size(), 1u);
  EXPECT_EQ(predicted[0]["p"], 3);
  EXPECT_EQ(predicted[0]["q"], 1);
  const double speed = predicted[0]["speed_rpm"];
  EXPECT_LT(speed, folds[0]);
  EXPECT_GT(speed, 0.97 * folds[0]);
  EXPECT_NEAR(predicted[0]["contacts"][0]["fast"], 1.0, 0.01);  // both swing most where it touches
  const json& found = predicted[0]["bouncing"];
  EXPECT_TRUE(found["stable"].get<bool>());
  EXPECT_GT(found["speed_rpm"], folds[0]);
  EXPECT_LT(found["speed_rpm"], folds[1]);

  const ResultReader file(folder / "resonances.h5");
  EXPECT_NEAR(file.vector("/resonances/speed")(0), speed * test::rpm, 1e-9);
  EXPECT_EQ(file.integers("/resonances/bouncing_stable")[0], 1);
  // its end is that motion
  const json orbit = result({"orbit", two_disk, "--frame", "rotating", "--from", "resonances.h5",
                             "--speed", std::to_string(found["speed_rpm"].get<double>()) + "rpm"});
  EXPECT_NEAR(orbit["period_revs"], found["period_revs"], 1e-5);
  EXPECT_LE(orbit["steps"], 2);
}

// A point of a branch in the rotating frame is an orbit there, from which another branch begins:
// along the speed first, then along the stiffness of the ring.
TEST_F(Branches, OfTheRotatingFrameAreChainedFromTheirPoints) {
  const json branch = result({"continue", two_disk, "--frame", "rotating", "--over",
                              "operation.speed=3000:7000:20rpm", "--at", "4430rpm", "--most", "8",
                              "--out", "branch.h5"});
  const json& point = branch["points"][6];
  const json orbit = result({"orbit", two_disk, "--frame", "rotating", "--from", "branch.h5",
                             "--point", "7", "--out", "orbit.h5"});
  EXPECT_NEAR(orbit["period_revs"], point["period_revs"], 1e-8);
  EXPECT_LE(orbit["steps"], 1);
  EXPECT_EQ(orbit["stable"], point["stable"]);
  const std::string speed = fmt::format("{:.17g}rad/s", point["value"].get<double>());
  const json next =
      result({"continue", two_disk, "--frame", "rotating", "--speed", speed, "--from", "orbit.h5",
              "--over", "contact.ring.stiffness=3:5:0.05MN/m", "--at", "4MN/m", "--most", "4"});
  EXPECT_NEAR(next["points"][0]["period_revs"], point["period_revs"], 1e-8);
}

TEST_F(Branches, OfTheRotatingFrameTakeNeitherPeriodsNorSwitches) {
  const test::Outcome o = whirl({"continue", two_disk, "--frame", "rotating", "--over",
                           "operation.speed=3000:7000:20rpm", "--period", "2"});
  EXPECT_EQ(o.status, 2);
  EXPECT_TRUE(has(o.err, "neither --period nor --switch")) << o.err;
  const test::Outcome heavy = whirl({"continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
                               "--frame", "rotating", "--over", "operation.speed=130:140rad/s"});
  EXPECT_EQ(heavy.status, 3);
  EXPECT_TRUE(has(heavy.err, "gravity, bearings, contacts or forces that tell directions apart"))
      << heavy.err;
  const test::Outcome nothing =
      whirl({"resonances", write("free.toml", jeffcott), "--speeds", "0:2000:20rpm", "--confirm"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(has(nothing.err, "contacts to bounce in")) << nothing.err;
}

// Stable points of a closed branch hold in a simulation seen from the rotor, unstable ones are
// left.
TEST_F(Branches, OfTheRotatingFrameAreWhatSimulationsSay) {
  result({"continue", two_disk, "--frame", "rotating", "--over", "operation.speed=3000:7000:20rpm",
          "--at", "4430rpm", "--out", "branch.h5"});
  const ResultReader file(folder / "branch.h5");
  const Vec value = file.vector("/branch/value"), revolutions = file.vector("/branch/revolutions");
  const auto stable = file.integers("/branch/stable");
  const CMat multiplier = file.complex_matrix("/branch/multiplier");
  EXPECT_EQ(multiplier.cols(), 16);
  for (std::size_t i = 0; i < stable.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_EQ(stable[i] == 1, std::abs(multiplier(k, 0)) < 1.0);
    EXPECT_TRUE(std::isnan(multiplier(k, 15).real()));  // that along the motion is left out
    EXPECT_NEAR(revolutions(k), 2.157, 0.002);
  }
  // a motion on its stable part is still there after 500 revolutions; beyond its folds it is gone
  result({"resonances", two_disk, "--speeds", "4200:4350:10rpm", "--modes", "2", "--confirm",
          "--out", "start.h5"});
  const auto after = [&](const std::string& speed) {
    return result({"orbit", two_disk, "--frame", "rotating", "--from", "start.h5", "--discard",
                   "500", "--speed", speed});
  };
  const json on = after("4400.8rpm");
  EXPECT_EQ(on["stable"], true);
  EXPECT_NEAR(on["period_revs"], 2.157, 0.002);
  EXPECT_GT(std::abs(after("4540rpm")["period_revs"].get<double>() - 2.157), 0.01);
}

// The period doubling at friction 0.128110 (138.4 rad/s, 64 MN/m) in the plane of friction and
// contact stiffness: the border goes through it, and killed and begun again it is the same.
TEST_F(Branches, HaveBordersInThePlaneOfTwoParameters) {
  const std::vector<std::string> line{"continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
                                      "--speed",  "138.4rad/s",
                                      "--over",   "contact.ring.friction=0.1:0.15:0.005",
                                      "--over",   "contact.ring.stiffness=60:68:0.5MN/m",
                                      "--at",     "0.15,64",
                                      "--out",    "borders.h5"};
  const json r = result(line);
  ASSERT_EQ(r["borders"].size(), 2u);  // both ways from 64 MN/m
  for (const json& border : r["borders"]) {
    EXPECT_EQ(border["kind"], "period-doubling");
    EXPECT_NEAR(border["points"][0][0], 0.128110487, 1e-7);
    EXPECT_NEAR(border["points"][0][1], 64e6, 1.0);
    EXPECT_GT(border["points"].size(), 3u);
  }
  // another point of it is where a branch at that stiffness doubles; not the last one, which is so
  // near to the end of the range that the transient at that end hardly settles
  const json& points = r["borders"][0]["points"];
  const json& point = points[points.size() - 2];
  const json again =
      result({"continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--speed", "138.4rad/s",
              "--set", "contact.ring.stiffness=" + std::to_string(point[1].get<double>()), "--over",
              "contact.ring.friction=0.1:0.15:0.005", "--at", "0.15"});
  bool is_there = false;
  for (const json& b : again["bifurcations"]) {
    is_there = is_there || std::abs(b["value"].get<double>() - point[0].get<double>()) < 1e-6;
  }
  EXPECT_TRUE(is_there) << again["bifurcations"];
  EXPECT_EQ(result(line)["borders"], r["borders"]);
}

// What repeats after T revolutions seen from the rotor is a circle seen from outside, turned by a
// multiple of 1 / T; its exponents are those of the orbit.
TEST_F(Branches, AreCirclesSeenFromOutside) {
  const std::vector<std::string> line{"torus",       two_disk, "--discard", "1500",
                                      "--harmonics", "33",     "--out",     "torus.h5"};
  const json circle = result(line);
  EXPECT_EQ(result(line)["exponents_per_rev"], circle["exponents_per_rev"]);  // from the file
  const json orbit = result({"orbit", two_disk, "--frame", "rotating"});
  const double turns = orbit["period_revs"], rotation = circle["rotation_per_rev"];
  constexpr double truncated = 1e-4;  // of a series of 33 harmonics over impacts
  EXPECT_NEAR(std::abs(std::remainder(rotation * turns, 1.0)), 0.0, truncated) << rotation;
  EXPECT_EQ(circle["stable"], true);
  const double size =
      std::hypot(orbit["floquet"][0][0].get<double>(), orbit["floquet"][0][1].get<double>());
  EXPECT_NEAR(circle["exponents_per_rev"][0], std::log(size) / turns, 1e-3);
  const ResultReader file(folder / "torus.h5");
  EXPECT_EQ(file.shape("/torus/displacement")[0], 67);
  const test::Outcome settled = whirl({"torus", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml"});
  EXPECT_EQ(settled.status, 3);
  EXPECT_TRUE(has(settled.err, "settled on a periodic orbit")) << settled.err;
}

// At 138.4 rad/s, 64 MN/m and friction 0.11 five orbits of one revolution coexist, all of them
// unstable.
TEST_F(Branches, BeginAtOrbitsOfASearch) {
  const json r = result({"orbit", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--speed",
                         "138.4rad/s", "--set", "contact.ring.stiffness=64e6", "--set",
                         "contact.ring.friction=0.11", "--starts", "60", "--size", "1"});
  EXPECT_GE(r["orbits"].size(), 3u);
  for (const json& orbit : r["orbits"]) {
    EXPECT_EQ(orbit["stable"], false);
    EXPECT_EQ(orbit["period_revs"], 1);
  }
}

}  // namespace whirl::branch_verbs_test
