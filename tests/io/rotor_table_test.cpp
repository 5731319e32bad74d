// [[rotor]] in model files: ratios, speeds of its own.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::rotor_table_test {

const std::string machine = R"(format = 1
[operation]
speed = "3000 rpm"
[[body]]
name = "inner"
mass = 10
spins = true
[[body]]
name = "outer"
mass = 5
spins = true
rotor = "hp"
[[bearing]]
body = "inner"
stiffness = 1e6
[[bearing]]
body = "outer"
stiffness = 1e6
[[rotor]]
name = "hp"
)";

Rotor rotor(const std::string& lines) {
  return parse_model(machine + lines).structure.rotors.at(0);
}

TEST(RotorTable, HasARatioOrASpeedOfItsOwn) {
  EXPECT_FALSE(rotor("ratio = 1.4\n").has_own_speed());
  EXPECT_DOUBLE_EQ(rotor("ratio = -1.4\n").speed_at(100.0), -140.0);
  const Rotor constant = rotor("speed = \"9000 rpm\"\n");
  ASSERT_TRUE(constant.has_own_speed());
  for (const double Omega : {0.0, 100.0, 1e4}) {
    EXPECT_DOUBLE_EQ(constant.speed_at(Omega), 9000.0 * rpm);
  }
}

TEST(RotorTable, FollowsATable) {
  const Rotor hp = rotor(
      "speeds = [[\"0 rpm\", \"0 rpm\"], [\"1000 rpm\", \"3000 rpm\"], [\"2000 rpm\", \"4000 "
      "rpm\"]]\n");
  EXPECT_DOUBLE_EQ(hp.speed_at(500.0 * rpm), 1500.0 * rpm);
  EXPECT_DOUBLE_EQ(hp.speed_at(1500.0 * rpm), 3500.0 * rpm);
  EXPECT_DOUBLE_EQ(hp.speed_at(5000.0 * rpm), 4000.0 * rpm);
}

TEST(RotorTable, SaysWhatIsWrong) {
  struct Wrong {
    const char *lines, *key, *says;
  };
  for (const Wrong& w : {Wrong{"", "ratio", "or its own speed"},
                         Wrong{"ratio = 1\nspeed = 10\n", "speed", "more than one"},
                         Wrong{"speed = 0\n", "speed", "found 0"},
                         Wrong{"speeds = [[0, 1], [0, 2]]\n", "speeds", "ascend"},
                         Wrong{"speeds = [[0, -1], [1, 2]]\n", "speeds", "both senses"},
                         Wrong{"speeds = [[0, 1, 2], [1, 2, 3]]\n", "speeds", "two rows"},
                         Wrong{"speeds = [[\"1 m\", 2], [3, 4]]\n", "speeds", "speed"}}) {
    try {
      rotor(w.lines);
      ADD_FAILURE() << w.lines;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.problems().front().key, std::string("rotor.hp.") + w.key) << w.lines;
      EXPECT_NE(error.problems().front().message.find(w.says), std::string::npos)
          << error.problems().front().message;
    }
  }
}

}  // namespace whirl::rotor_table_test
