// The bow of a shaft, modal damping and masses along x and y in model files.

#include <gtest/gtest.h>

#include <fstream>

#include "libio/model/bow_table.hpp"
#include "tests/io/problems.hpp"
#include "tests/io/result_folder.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::test {
namespace model_bow_test {

std::string problems_in(const std::string& text) {
  std::vector<Problem> found;
  parse_bow_table(text, "bow.csv", found);
  std::string all;
  for (const Problem& p : found) all += describe(p) + "\n";
  return all;
}

TEST(BowTable, IsReadAlongAxesOrByAngle) {
  std::vector<Problem> none;
  const Bow a =
      parse_bow_table("position [mm], x [um], y [um]\n0,0,0\n300,30,-40\n600,0,0\n", "b", none);
  EXPECT_EQ(a.z, (std::vector<double>{0.0, 0.3, 0.6}));
  EXPECT_DOUBLE_EQ(a.x[1], 30e-6);
  EXPECT_DOUBLE_EQ(a.y[1], -40e-6);
  const Bow b = parse_bow_table("angle [deg]; bow [mil]; z [in]\n0;0;0\n90;2;10\n", "b", none);
  EXPECT_NEAR(b.x[1], 0.0, 1e-20);
  EXPECT_DOUBLE_EQ(b.y[1], 50.8e-6);
  EXPECT_DOUBLE_EQ(b.z[1], 0.254);
  EXPECT_TRUE(none.empty());
}

TEST(BowTable, ProblemsNameTheirLines) {
  EXPECT_EQ(problems_in("x,y\n0,0\n1,1\n"),
            "bow.csv:1:1: position: missing, expected positions (m)\n");
  EXPECT_EQ(problems_in("position\n0\n1\n"),
            "bow.csv:1:1: x: missing, expected x and y, or deflection and angle\n");
  EXPECT_EQ(problems_in("position,x,deflection\n0,0,0\n1,1,1\n"),
            "bow.csv:1:1: deflection: expected x and y, or deflection and angle\n");
  EXPECT_EQ(problems_in("position,angle\n0,0\n1,1\n"),
            "bow.csv:1:1: deflection: expected x and y, or deflection and angle\n");
  EXPECT_EQ(problems_in("position,x\n0,0\n0,1\n,2\n"),
            "bow.csv:3:1: position: positions must ascend from line to line\n"
            "bow.csv:4:1: position: missing, expected a length (m)\n");
  for (const char* text : {"", "position,x\n", "position,x\n0,1\n"}) {
    EXPECT_EQ(problems_in(text), "bow.csv: expected a line of column names and two rows at least\n")
        << text;
  }
}

using BowFile = InResultFolder;

TEST_F(BowFile, IsReadWithTheModelAndKeptInResults) {
  std::ofstream(folder / "bow.csv") << "position,y\n0,0\n0.3,1e-4\n0.6,0\n";
  const Model model = parse_model(rotor().source + "[bow]\ntable = \"bow.csv\"\n", "m", {}, folder);
  EXPECT_EQ(model.structure.bow.y[1], 1e-4);
  const Model again = parse_model(model.source, "result.h5");
  EXPECT_EQ(again.structure.bow.y[1], 1e-4);
}

TEST(ModelBow, NeedsATableAndAShaft) {
  const std::string body = "format = 1\n[[body]]\nname = \"b\"\nmass = 1\n";
  EXPECT_EQ(joined(problems(body + "[bow]\n")),
            "m:5:1: bow.table: missing, expected a file with the shaft's deflections against "
            "position (CSV)\n");
  EXPECT_EQ(joined(problems(body + "[bow]\ntable = \"\"\"position,x\n0,0\n1,1\n\"\"\"\n")),
            "m:6:9: bow.table: a bow is one of a shaft: there is none\n");
}

// Positions are along the axis of the first shaft, where stations of the rotor are, too.
TEST_F(BowFile, IsOneOfAFurtherShaftToo) {
  std::ofstream(folder / "outer.csv") << "position [mm],y [um]\n100,0\n200,30\n400,0\n";
  const std::string outer = "[[rotor]]\nname = \"outer\"\nratio = -1.5\nposition = 0.1\n";
  const std::string shaft =
      "[[shaft]]\nrotor = \"outer\"\nmaterial = \"steel\"\nlength = 0.3\nouter_diameter = 0.1\n"
      "inner_diameter = 0.08\n[[bearing]]\nrotor = \"outer\"\nat = 0.1\nstiffness = 1e7\n"
      "[[bearing]]\nrotor = \"outer\"\nat = 0.4\nstiffness = 1e7\n";
  const std::string bent = outer + "bow = \"outer.csv\"\n";
  const Model model = parse_model(rotor().source + bent + shaft, "m", {}, folder);
  for (const Model& m : {model, parse_model(model.source, "result.h5")}) {
    EXPECT_TRUE(m.structure.bow.z.empty());
    EXPECT_DOUBLE_EQ(m.structure.rotors[0].bow.z[1], 0.2);
    EXPECT_DOUBLE_EQ(m.structure.rotors[0].bow.y[1], 30e-6);
  }
  EXPECT_EQ(joined(problems(rotor().source + outer + "bow = \"\"\"position,x\n0,0\n1,1\n\"\"\"\n")),
            "m:12:1: rotor.outer.bow: a bow is one of a shaft: there is none\n");
}

TEST(ModelDamping, OfModesIsOneRatioOrAList) {
  const auto modal = [](const std::string& value) {
    return rotor("[damping]\nmodal = " + value + "\n").structure.modal_damping;
  };
  EXPECT_EQ(modal("0.01").ratios, std::vector<double>{0.01});
  EXPECT_TRUE(modal("0.01").is_common);
  EXPECT_EQ(modal("[0.01, 0, 0.02]").ratios, (std::vector<double>{0.01, 0.0, 0.02}));
  EXPECT_FALSE(modal("[0.01]").is_common);
  const std::string head = "format = 1\n[[body]]\nname = \"b\"\nmass = 1\n[damping]\n";
  EXPECT_EQ(joined(problems(head + "modal = []\n")),
            "m:6:9: damping.modal: found an empty list, expected a list of one or more\n");
  EXPECT_EQ(joined(problems(head + "modal = [0.1, 1.5]\n")),
            "m:6:9: damping.modal: found 1.5, expected damping ratios below 1\n");
  EXPECT_EQ(joined(problems(head + "modal = -0.1\n")),
            "m:6:9: damping.modal: found -0.1, expected a number without unit of zero or more\n");
  EXPECT_EQ(joined(problems(head + "modal = [\"x\"]\n")),
            "m:6:10: damping.modal: \"x\" is not a number, expected a number without unit\n");
}

TEST(ModelBody, MayWeighDifferentlyAlongXAndY) {
  const std::string head = "format = 1\n[[body]]\nname = \"b\"\n";
  const Structure s = parse_model(head + "mass = [\"4 kg\", 9]\n").structure;
  EXPECT_EQ(s.bodies[0].m.x, 4.0);
  EXPECT_EQ(s.bodies[0].m.y, 9.0);
  EXPECT_EQ(joined(problems(head + "mass = [4, 9]\nspins = true\n")),
            "m:4:8: body.b.mass: a body that spins has the same mass along x and y, expected one "
            "value\n");
  EXPECT_EQ(joined(problems(head + "mass = [4]\n")),
            "m:4:8: body.b.mass: found a list of 1, expected one mass, or [along x, along y]\n");
  EXPECT_EQ(joined(problems(head + "mass = [4, -9]\n")),
            "m:4:12: body.b.mass: found -9, expected a mass (kg) of zero or more\n");
}

}  // namespace model_bow_test
}  // namespace whirl::test
