// [[gear]] in model files.

#include <gtest/gtest.h>

#include <string>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::gear_table_test {

const std::string machine = R"(format = 1
[[rotor]]
name = "pinion"
ratio = -2.5
[[body]]
name = "a"
mass = 4
spins = true
[[body]]
name = "b"
mass = 1
spins = true
rotor = "pinion"
[[gear]]
name = "teeth"
driving = "a"
stiffness = "400 MN/m"
driving_radius = "250 mm"
)";

TEST(GearTable, IsReadInItsUnits) {
  const Model model = parse_model(machine +
                                  "driven = { body = \"b\" }\n"
                                  "driven_radius = \"100 mm\"\n"
                                  "centers = \"90 deg\"\n"
                                  "helix_angle = \"-12 deg\"\n");
  ASSERT_EQ(model.structure.gears.size(), 1u);
  const GearPair& gears = model.structure.gears.front();
  EXPECT_EQ(gears.name, "teeth");
  EXPECT_EQ(gears.driving.body, "a");
  EXPECT_EQ(gears.driven.body, "b");
  EXPECT_EQ(gears.stiffness, 4e8);
  EXPECT_EQ(gears.damping, 0.0);
  EXPECT_EQ(gears.driving_radius, 0.25);
  EXPECT_EQ(gears.driven_radius, 0.1);
  EXPECT_NEAR(gears.centers, 0.5 * test::pi, 1e-15);
  EXPECT_NEAR(gears.pressure_angle, test::pi / 9.0, 1e-15);
  EXPECT_NEAR(gears.helix_angle, -test::pi / 15.0, 1e-15);
}

/// The only problem of the machine with these lines.
Problem problem_of(const std::string& lines) {
  try {
    parse_model(machine + lines);
  } catch (const ModelError& error) {
    EXPECT_EQ(error.problems().size(), 1u) << error.what();
    return error.problems().front();
  }
  ADD_FAILURE() << "taken";
  return {};
}

TEST(GearTable, MistakesAreToldWithWhatWouldBeRight) {
  const Problem radius = problem_of("driven = \"b\"\ndriven_radius = \"80 mm\"\n");
  EXPECT_EQ(radius.key, "gear.teeth");
  EXPECT_NE(radius.message.find("-2.5 times; expected -3.125 by the radii"), std::string::npos)
      << radius.message;
  const Problem ground = problem_of("driven = \"ground\"\ndriven_radius = \"0.1 m\"\n");
  EXPECT_EQ(ground.key, "gear.teeth.driven");
  const Problem angle =
      problem_of("driven = \"b\"\ndriven_radius = \"0.1 m\"\npressure_angle = \"90 deg\"\n");
  EXPECT_EQ(angle.key, "gear.teeth.pressure_angle");
}

}  // namespace whirl::gear_table_test
