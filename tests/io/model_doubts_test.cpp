// What a model says that is right and seldom meant.

#include "libio/model/model_doubts.hpp"

#include <gtest/gtest.h>

#include "libio/model/model_file.hpp"

namespace whirl::test {
namespace model_doubts_test {

std::string lines_of(const std::vector<Problem>& problems) {
  std::string all;
  for (const Problem& p : problems) all += describe(p) + "\n";
  return all;
}

/// Lines of the doubts of a model, "m:line:column: key: message".
std::string doubts(const std::string& text, const std::vector<std::string>& sets = {}) {
  return lines_of(model_doubts(text, "m", sets, "."));
}

/// A shaft of some length and diameter on two bearings.
std::string rotor(const std::string& length, const std::string& diameter,
                  const std::string& more = "") {
  return "format = 1\n[material.steel]\ndensity = 7800\nyoungs_modulus = \"211 GPa\"\n"
         "poisson_ratio = 0.3\n[[shaft]]\nmaterial = \"steel\"\nlength = " +
         length + "\nouter_diameter = " + diameter +
         "\n[[bearing]]\nat = 0\nstiffness = 1e8\n[[bearing]]\nat = " + length +
         "\nstiffness = 1e8\n" + more;
}

TEST(ModelDoubts, AUsualModelHasNone) {
  EXPECT_EQ(doubts(rotor("\"1.7 m\"", "\"140 mm\"")), "");
  EXPECT_EQ(doubts(rotor("29", "0.4")), "");
}

TEST(ModelDoubts, MillimetersWithoutTheirUnitAreMeters) {
  EXPECT_EQ(
      doubts(rotor("68", "2")),
      "m:6:1: shaft: the shaft is as long as 68 m; lengths without a unit are meters: did you "
      "mean 68 mm, or in?\n");
  EXPECT_EQ(doubts(rotor("\"500 mm\"", "75")),
            "m:6:1: shaft: the outer diameter is 75 m; lengths without a unit are meters: did you "
            "mean 75 mm, or in?\n");
  EXPECT_EQ(
      doubts(rotor("0.5", "\"0.075 mm\"")),
      "m:6:1: shaft: the shaft is 6667 times as long as it is thick (0.5 m, 0.075 mm at most): "
      "is one of them in another unit?\n");
}

TEST(ModelDoubts, DegreesWithoutTheirUnitAreRadians) {
  const std::string probe = "[[probe]]\nname = \"1.5 X\"\nat = 0\nangle = ";
  const std::string force =
      "[[force]]\nname = \"pump\"\nat = 0\nforce = 1\norder = 2\nangle = 90.5\nphase = -30\n";
  EXPECT_EQ(doubts(rotor("1", "0.1", probe + "45\n")),
            "m:19:9: probe.1.5 X.angle: 45 without a unit is 45 rad = 2578 deg; did you mean \"45 "
            "deg\"?\n");
  EXPECT_EQ(doubts(rotor("1", "0.1", probe + "\"45 rad\"\n")), "");
  EXPECT_EQ(doubts(rotor("1", "0.1", probe + "6.28\n")), "");
  const std::string two = doubts(rotor("1", "0.1", force));
  EXPECT_NE(two.find("m:21:9: force.pump.angle: 90.5 without a unit"), std::string::npos) << two;
  EXPECT_NE(two.find("m:22:9: force.pump.phase: -30 without a unit"), std::string::npos) << two;
  EXPECT_EQ(doubts(rotor("1", "0.1", "[[unbalance]]\nat = 0\nmoment = 1e-5\nphase = 180\n"))
                .find("m:19:9: unbalance.1.phase: 180 without a unit is 180 rad"),
            0u);
  EXPECT_EQ(doubts(rotor("1", "0.1",
                         "[[contact]]\nat = 0\ngeometry = \"stop\"\nangle = 270\nclearance = "
                         "1e-3\nstiffness = 1e6\n"))
                .find("m:19:9: contact.1.angle: 270 without a unit"),
            0u);
  EXPECT_EQ(doubts(rotor("1", "0.1", probe + "0\n"), {"probe.1.angle=45"})
                .find("--set probe.1.angle=45: probe.1.5 X.angle: 45 without"),
            0u);
}

// A layer that begins below the surface of the shaft has its metal twice.
TEST(ModelDoubts, LayersInTheShaftOrInOneAnotherCountTwice) {
  const auto layer = [](const char* name, const char* from, const char* to, const char* outer,
                        const char* inner, const char* more = "") {
    return std::string("[[layer]]\nname = \"") + name + "\"\nfrom = \"" + from + "\"\nto = \"" +
           to + "\"\nmaterial = \"steel\"\nouter_diameter = \"" + outer +
           "\"\ninner_diameter = \"" + inner + "\"\n" + more;
  };
  const auto of = [&](const std::string& layers) { return doubts(rotor("1", "0.1", layers)); };
  EXPECT_EQ(of(layer("sleeve", "200 mm", "400 mm", "120 mm", "100 mm")), "");
  EXPECT_EQ(of(layer("sleeve", "200 mm", "400 mm", "120 mm", "95 mm")),
            "m:16:1: layer.sleeve: lies in the shaft from 200 to 400 mm: what is between the "
            "diameters 95 and 100 mm counts twice; a layer begins at the outer diameter of what it "
            "lies on\n");
  EXPECT_EQ(
      of(layer("sleeve", "200 mm", "400 mm", "120 mm", "100 mm") +
         layer("hub", "300 mm", "500 mm", "150 mm", "110 mm")),
      "m:23:1: layer.hub: lies in layer sleeve from 300 to 400 mm: what is between the "
      "diameters 110 and 120 mm counts twice; a layer begins at the outer diameter of what it "
      "lies on\n");
  // side by side, and one that weighs where the other one is stiff
  EXPECT_EQ(of(layer("a", "200 mm", "300 mm", "120 mm", "100 mm") +
               layer("b", "300 mm", "500 mm", "150 mm", "100 mm")),
            "");
  EXPECT_EQ(of(layer("a", "200 mm", "300 mm", "120 mm", "100 mm", "carries = \"mass\"\n") +
               layer("b", "200 mm", "300 mm", "110 mm", "100 mm", "carries = \"stiffness\"\n")),
            "");
}

// In a table many rows make the same mistake: it is told once, at the cell.
TEST(ModelDoubts, LayersOfATableAreToldAtTheirCells) {
  const std::string table =
      "[[shaft]]\nmaterial = \"steel\"\ntable = \"\"\"length [mm];od [mm];id [mm];layer\n"
      "100;50;;1\n;70;45;2\n100;50;;1\n;70;45;2\n\"\"\"\n";
  EXPECT_EQ(
      doubts("format = 1\n[material.steel]\ndensity = 7800\nyoungs_modulus = \"211 GPa\"\n"
             "poisson_ratio = 0.3\n" +
             table),
      "m:8: shaft.1.table:3:5: inner_diameter: lies in the shaft from 0 to 100 mm: what is "
      "between the "
      "diameters 45 and 50 mm counts twice; a layer begins at the outer diameter of what it lies "
      "on; and 1 more row\n");
}

TEST(ModelDoubts, ColumnsThatABearingLacksAreDoubtedOncePerTable) {
  const std::string bearing =
      "[[bearing]]\nat = 0.5\ntable = \"\"\"rpm;kxx;cxx;cyy\n1000;1;2;3\n\"\"\"\n";
  EXPECT_EQ(doubts(rotor("1", "0.1", bearing)),
            "m:18: bearing.3.table:1:5: kyy: this table has no such column beside kxx: it is "
            "taken as "
            "zero\n");
}

// A mass m on springs k sags by m g / k, here 10 mm: 8 mm more than the clearance, and none along +y.
TEST(ModelDoubts, ContactsThatTouchAtRest) {
  const auto at_rest = [](const std::string& clearance) {
    const Model model = parse_model(
        "format = 1\ngravity = 10\n[[body]]\nname = \"b\"\nmass = 1\nspins = "
        "true\n[[bearing]]\nbody = "
        "\"b\"\nstiffness = 1000\n[[contact]]\nname = \"ring\"\nbody = \"b\"\nstiffness = "
        "1e6\nclearance = \"" +
            clearance + "\"\n",
        "m");
    return lines_of(rest_doubts(model_facts(model, Assembler(model.structure)), model));
  };
  EXPECT_EQ(
      at_rest("2 mm"),
      "m:10:1: contact ring: touches at rest: the rotor is 10 mm from the middle, the clearance "
      "is 2 mm, -8 mm are left\n");
  EXPECT_EQ(at_rest("11 mm"), "");
}

}  // namespace model_doubts_test
}  // namespace whirl::test
