// The command line: branches of orbits in the rotating frame, and where they are born.

#include "libio/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::branch_verbs_test {

using namespace test;

class Branches : public Program {
 protected:
  const std::string two_disk = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
};

// The 3:1 bouncing motion of the two-disk rotor at 4430 rpm lives on a closed branch between two folds.
// Its first forward and first backward mode are in resonance somewhat below the lower one, as the
// contact stiffens the rotor.
TEST_F(Branches, OfBouncingBeginAboveTheInternalResonance) {
  const json branch = result({"continue", two_disk, "--frame", "rotating", "--over",
                              "operation.speed=3000:7000:20rpm", "--at", "4430rpm"});
  ASSERT_EQ(branch["branches"].size(), 1u);
  EXPECT_EQ(branch["branches"][0]["end"], "it closes: the first orbit again");
  std::vector<double> folds;
  for (const json& b : branch["bifurcations"]) {
    if (b["kind"] == "fold") folds.push_back(b["value"].get<double>() / rpm);
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
  EXPECT_NEAR(file.vector("/resonances/speed")(0), speed * rpm, 1e-9);
  EXPECT_EQ(file.integers("/resonances/bouncing_stable")[0], 1);
  // its end is that motion
  const json orbit = result({"orbit", two_disk, "--frame", "rotating", "--from", "resonances.h5",
                             "--speed", std::to_string(found["speed_rpm"].get<double>()) + "rpm"});
  EXPECT_NEAR(orbit["period_revs"], found["period_revs"], 1e-5);
  EXPECT_LE(orbit["steps"], 2);
}

TEST_F(Branches, OfTheRotatingFrameTakeNeitherPeriodsNorSwitches) {
  const Outcome o = whirl({"continue", two_disk, "--frame", "rotating", "--over",
                           "operation.speed=3000:7000:20rpm", "--period", "2"});
  EXPECT_EQ(o.status, 2);
  EXPECT_TRUE(has(o.err, "neither --period nor --switch")) << o.err;
  const Outcome heavy = whirl({"continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
                               "--frame", "rotating", "--over", "operation.speed=130:140rad/s"});
  EXPECT_EQ(heavy.status, 3);
  EXPECT_TRUE(has(heavy.err, "gravity, bearings or contacts")) << heavy.err;
  const Outcome nothing =
      whirl({"resonances", write("free.toml", jeffcott), "--speeds", "0:2000:20rpm", "--confirm"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(has(nothing.err, "contacts to bounce in")) << nothing.err;
}

}  // namespace whirl::branch_verbs_test
