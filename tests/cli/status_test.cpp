// How far studies are, told by their files.

#include <regex>

#include "tests/cli/studies.hpp"

namespace whirl::test {

namespace status_test {

class Status : public Studies {
 protected:
  json status(const std::string& file) const { return result({"status", file})["studies"][0]; }
  long done_in(const std::string& file) const {
    const std::vector<double> done = ResultReader(folder / file).numbers("/map/done");
    return std::count(done.begin(), done.end(), 1.0);
  }
  const std::vector<std::string> large{"map",       stator,
                                       "--over",    "operation.speed=130:160:0.1rad/s",
                                       "--over",    "contact.ring.friction=0:0.3:0.02",
                                       "--discard", "300",
                                       "--out",     "map.h5"};
};

TEST_F(Status, OfACompleteStudy) {
  ASSERT_EQ(whirl({"map", "rub.toml", "--over", "operation.speed=90:100:5rad/s", "--over",
                   "contact.ring.stiffness=2e4,3e4", "--discard", "20", "--revolutions", "10",
                   "--out", "map.h5"})
                .status,
            0);
  const json s = status("map.h5");
  EXPECT_EQ(s["file"], "map.h5");
  EXPECT_EQ(s["verb"], "map");
  EXPECT_EQ(s["done"], 6);
  EXPECT_EQ(s["points"], 6);
  EXPECT_EQ(s["failed"], 0);
  EXPECT_EQ(s["complete"], true);
  EXPECT_EQ(s["is_running"], false);
  EXPECT_EQ(s["left_s"], 0.0);
  EXPECT_TRUE(has(whirl({"status", "map.h5"}).out, "map, 6 of 6 points\n    complete; saved 2"));
}

// While it runs, and after it was stopped; the time left is that of the rest at the rate so far.
TEST_F(Status, OfAStudyThatRunsAndOfOneThatWasStopped) {
  const pid_t child = start(WHIRL_PROGRAM, large);
  for (int i = 0; i < 6000 && !std::filesystem::exists(folder / "map.h5"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const Outcome told = wait(start(WHIRL_PROGRAM, {"status", "map.h5", "--json", "running.json"}));
  EXPECT_EQ(told.status, 0);
  const json running = json::parse(content(folder / "running.json"))["studies"][0];
  EXPECT_EQ(running["is_running"], true);
  EXPECT_EQ(running["complete"], false);
  EXPECT_EQ(running["points"], 301 * 16);
  ::kill(child, SIGTERM);
  EXPECT_EQ(wait(child).status, 130);

  const json stopped = status("map.h5");
  EXPECT_EQ(stopped["is_running"], false);
  EXPECT_EQ(stopped["complete"], false);
  EXPECT_EQ(stopped["done"], done_in("map.h5"));
  EXPECT_GE(stopped["done"], running["done"]);
  const double rate = stopped["rate_per_s"], left = stopped["left_s"];
  EXPECT_GT(rate, 0.0);
  EXPECT_NEAR(left * rate, 301 * 16 - stopped["done"].get<long>(), 1e-6 * left * rate);
  const double seconds = ResultReader(folder / "map.h5").number_attribute("/", "seconds");
  EXPECT_NEAR(rate * seconds, stopped["done"].get<double>(), 1e-6 * rate * seconds);
  const std::string text = whirl({"status", "map.h5"}).out;
  EXPECT_TRUE(std::regex_search(
      text,
      std::regex("stopped: the same line goes on from there; [0-9.]+/s, [0-9:]+ left; saved")))
      << text;

  // the time of both runs counts
  EXPECT_EQ(interrupted(large, {SIGTERM}).status, 130);
  EXPECT_GT(ResultReader(folder / "map.h5").number_attribute("/", "seconds"), seconds);
}

// Two of four motions grow beyond all bounds, and are done.
TEST_F(Status, CountsPointsThatFailed) {
  ASSERT_EQ(
      whirl({"map", "rub.toml", "--set", "bearing.shaft.stiffness={xx=2e4,yy=2e4,xy=0,yx=-1e6}",
             "--over", "bearing.shaft.stiffness.xy=0,1e6", "--over", "contact.ring.clearance=4,5mm",
             "--discard", "1000", "--out", "map.h5"})
          .status,
      0);
  const json s = status("map.h5");
  EXPECT_EQ(s["done"], 4);
  EXPECT_EQ(s["failed"], 2);
  EXPECT_TRUE(has(whirl({"status", "map.h5"}).out, "4 of 4 points, 2 of them failed"));
}

TEST_F(Status, OfBranchesHasNoEnd) {
  ASSERT_EQ(whirl({"continue", "rub.toml", "--over", "bearing.1.damping=200:210", "--points", "3",
                   "--discard", "10", "--out", "branch.h5"})
                .status,
            0);
  const json s = status("branch.h5");
  EXPECT_EQ(s["verb"], "continue");
  EXPECT_GE(s["done"], 3);
  EXPECT_TRUE(s["points"].is_null());
  EXPECT_TRUE(s["left_s"].is_null());
  EXPECT_EQ(s["complete"], true);
}

// What version 0.1.0 wrote does not say how long it took.
TEST_F(Status, OfAnEarlierVersion) {
  std::filesystem::copy_file(WHIRL_TEST_DATA "/earlier/map_0.1.0.h5", folder / "map.h5");
  const json s = status("map.h5");
  EXPECT_EQ(s["done"], 4);
  EXPECT_TRUE(s["rate_per_s"].is_null());
  EXPECT_EQ(s["complete"], true);
}

TEST_F(Status, OfOtherResultsIsRefused) {
  ASSERT_EQ(whirl({"modes", "rub.toml", "--out", "modes.h5"}).status, 0);
  const Outcome modes = whirl({"status", "modes.h5"});
  EXPECT_EQ(modes.status, 2);
  EXPECT_TRUE(has(modes.err, "modes.h5 holds no study, but what whirl modes found")) << modes.err;
  EXPECT_EQ(whirl({"status", "nothing.h5"}).status, 2);
  EXPECT_EQ(whirl({"status", "rub.toml"}).status, 2);
  EXPECT_EQ(whirl({"status", "modes.h5", "--out", "x.h5"}).status, 2);
}

}  // namespace status_test
}  // namespace whirl::test
