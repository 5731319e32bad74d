// What earlier versions wrote: it opens, and a study that they began is not gone on with. The files
// are a map of two by two points as 0.1.0 left it, and a record of one probe that 0.2.0 identified,
// but for most of its samples, from before it told positions of probes.

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {

namespace earlier_version_test {

class EarlierVersion : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::filesystem::copy_file(WHIRL_TEST_DATA "/earlier/map_0.1.0.h5", folder / "map.h5");
    write("rub.toml", ResultReader(folder / "map.h5").strings("/model").at(0));
  }

  const std::vector<std::string> words{"map",           "rub.toml",
                                       "--over",        "operation.speed=90,100rad/s",
                                       "--over",        "contact.ring.stiffness=2e4,3e4",
                                       "--discard",     "20",
                                       "--revolutions", "10",
                                       "--out",         "map.h5"};
};

TEST_F(EarlierVersion, ItsResultsAreShown) {
  for (const std::vector<std::string>& verb : {std::vector<std::string>{"report", "map.h5"},
                                               {"plot", "map.h5", "map", "--out", "map.svg"},
                                               {"export", "map.h5", "--format", "csv"}}) {
    const Outcome o = whirl(verb);
    EXPECT_EQ(o.status, 0) << verb.front() << ": " << o.err;
  }
  EXPECT_NE(content(folder / "map.svg").find("<svg"), std::string::npos);
}

TEST_F(EarlierVersion, ItsMeasurementsAreShown) {
  const std::string file = WHIRL_TEST_DATA "/earlier/identify_0.2.0.h5";
  for (const char* kind : {"measured_spectrum", "measured_orbit", "mac", "modes"}) {
    const Outcome o = whirl({"plot", file, kind, "--out", "m.svg", "--force"});
    EXPECT_EQ(o.status, 0) << kind << ": " << o.err;
  }
  const Outcome all = whirl({"plot", file});
  EXPECT_FALSE(has(all.out, "measured_deflection")) << all.out;
  EXPECT_FALSE(has(all.out, "cannot be drawn")) << all.out;
}

TEST_F(EarlierVersion, ItsStudiesBeginAnewWhenAsked) {
  const std::string before = content(folder / "map.h5");
  const Outcome refused = whirl(words);
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "was begun by whirl 0.1.0")) << refused.err;
  EXPECT_TRUE(has(refused.err, "--restart")) << refused.err;
  EXPECT_EQ(content(folder / "map.h5"), before);

  std::vector<std::string> anew = words;
  anew.emplace_back("--restart");
  EXPECT_EQ(result(anew)["resumed"], 0);
}

}  // namespace earlier_version_test

}  // namespace whirl::test
