// Probes in model files: what is read, what is said of mistakes.

#include <gtest/gtest.h>

#include <numbers>

#include "libdyn/system/stations.hpp"
#include "tests/io/problems.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::model_probes_test {

using test::joined;
using test::problems;

TEST(ModelProbes, AreReadWithEveryKey) {
  const Structure s = test::rotor(R"(
[[probe]]
name = "DE 1X"
at = "125 mm"
angle = "45 deg"
unit = "mil"
[[probe]]
node = 13
angle = -1.5
)")
                          .structure;
  ASSERT_EQ(s.probes.size(), 2u);
  EXPECT_EQ(s.probes[0].name, "DE 1X");
  EXPECT_EQ(s.probes[0].at.z, 0.125);
  EXPECT_DOUBLE_EQ(s.probes[0].angle, std::numbers::pi / 4.0);
  EXPECT_EQ(s.probes[0].unit, "mil");
  EXPECT_EQ(s.probes[1].name, "probe 2");
  EXPECT_EQ(s.probes[1].at.node, 13);
  EXPECT_EQ(s.probes[1].angle, -1.5);
  EXPECT_EQ(s.probes[1].unit, "um");
}

TEST(ModelProbes, HaveANodeThatIsNamedByThem) {
  const Model model = test::rotor("[[probe]]\nname = \"1X\"\nat = 0.125\nangle = 0\n");
  const Assembler assembler(model.structure);
  const auto points = select_points(model, assembler, "1X");
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].label(), "14 1X");  // behind the 13 of the mesh
  EXPECT_EQ(assembler.mesh().z[13], 0.125);
}

TEST(ModelProbes, TakeValuesFromTheCommandLine) {
  const Model model = test::rotor("[[probe]]\nname = \"1X\"\nat = 0.1\nangle = 0\n",
                                  {"probe.1X.angle=90deg", "probe.1.unit=mm"});
  EXPECT_DOUBLE_EQ(model.structure.probes[0].angle, 0.5 * std::numbers::pi);
  EXPECT_EQ(model.structure.probes[0].unit, "mm");
}

TEST(ModelProbes, ThatAreWrongAreToldWithTheirLines) {
  const std::string head = "format = 1\n[[body]]\nname = \"b\"\nmass = 1\n";
  EXPECT_EQ(joined(problems(head + "[[probe]]\nbody = \"b\"\nangle = 0\nunit = \"N\"\n")),
            "m:8:8: probe.1.unit: found \"N\", expected a unit of length, such as \"um\", \"mil\" "
            "or \"mm\"\n");
  EXPECT_EQ(
      joined(problems(head + "[[probe]]\nbody = \"b\"\nangle = 0\nunit = \"\"\n")),
      "m:8:8: probe.1.unit: found \"\", expected a unit of length, such as \"um\", \"mil\" or "
      "\"mm\"\n");
  EXPECT_EQ(joined(problems(head + "[[probe]]\nname = \"1X\"\nbody = \"c\"\nangle = \"3 mm\"\n")),
            "m:7:8: probe.1X.body: found \"c\", expected b\n"
            "m:8:9: probe.1X.angle: found \"3 mm\", expected an angle (rad)\n");
  EXPECT_EQ(joined(problems(head + "[[probe]]\n")),
            "m:5:1: probe.1.at: missing, expected a station: at = position, node = number, or body "
            "= name\n"
            "m:5:1: probe.1.angle: missing, expected an angle (rad)\n");
  EXPECT_EQ(joined(problems(head + "[[probe]]\nbody = \"b\"\nangel = 0\n")),
            "m:7:1: probe.1.angel: unknown key, did you mean \"angle\"?\n");
  EXPECT_EQ(joined(problems(head + "[[probe]]\nname = \"\"\nbody = \"b\"\nangle = 0\n")),
            "m:6:8: probe..name: a probe needs a name that is not empty\n");
  EXPECT_EQ(joined(problems(head + "[probe]\nbody = \"b\"\nangle = 0\n")),
            "m:5:2: probe: expected an array of tables: write [[probe]]\n");
}

}  // namespace whirl::model_probes_test
