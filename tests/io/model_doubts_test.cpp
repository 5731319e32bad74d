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

TEST(ModelDoubts, SizesThatDoNotGoTogether) {
  const std::string disk =
      "[[disk]]\nname = \"d\"\nat = 0.2\nmaterial = \"steel\"\nouter_diameter = 0.4\nwidth = ";
  EXPECT_EQ(doubts(rotor("1", "0.1", disk + "0.3\n")), "");
  EXPECT_EQ(
      doubts(rotor("1", "0.1", disk + "0.5\n")),
      "m:21:9: disk.d.width: the disk is 500 mm wide and reaches over bearing 1, 200 mm beside "
      "its middle\n");
  EXPECT_EQ(doubts(rotor("1", "0.1", disk + "1.5\n")),
            "m:21:9: disk.d.width: the disk is 1.5 m wide, the shaft 1 m long\n");
  const std::string contact =
      "[[contact]]\nname = \"c\"\nat = 0.5\nstiffness = 1e6\nclearance = \"60 mm\"\n";
  EXPECT_EQ(doubts(rotor("1", "0.1", contact)),
            "m:20:13: contact.c.clearance: 60 mm is more than the radius of the shaft there, 50 "
            "mm\n");
  EXPECT_EQ(doubts(rotor("1", "0.13", contact)), "");
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

std::string material(const std::string& density, const std::string& modulus) {
  return "format = 1\n[material.steel]\ndensity = " + density + "\nyoungs_modulus = " + modulus +
         "\npoisson_ratio = 0.3\n[[shaft]]\nmaterial = \"steel\"\nlength = 1\nouter_diameter = "
         "0.1\n";
}

// Numbers that are another thing in the unit that was meant: those of machines are far from them in
// SI.
TEST(ValueDoubts, NumbersWithoutTheirUnitAreSi) {
  EXPECT_EQ(doubts(material("7850", "2.1e11")), "");
  EXPECT_EQ(doubts(material("0", "2.1e11") + "[[disk]]\nat = 0\nmass = 1\n"), "");  // massless
  EXPECT_EQ(doubts(material("0.283", "2.1e11")),
            "m:3:11: material.steel.density: 0.283 without a unit is 0.283 kg/m^3: steel has 7850 "
            "kg/m^3; did you mean \"0.283 lb/in^3\"?\n");
  EXPECT_EQ(doubts(material("7.85", "2.1e11")),
            "m:3:11: material.steel.density: 7.85 without a unit is 7.85 kg/m^3: steel has 7850 "
            "kg/m^3; did you mean \"7.85 g/cm^3\"?\n");
  EXPECT_EQ(doubts(material("\"0.283 kg/m^3\"", "2.1e11")), "");  // who writes the unit means it
  EXPECT_EQ(doubts(material("7850", "210")),
            "m:4:18: material.steel.youngs_modulus: 210 without a unit is 210 Pa: steel has 2.1e11 "
            "Pa; did you mean \"210 GPa\"?\n");
  EXPECT_EQ(doubts(material("7850", "30e6")),
            "m:4:18: material.steel.youngs_modulus: 3e+07 without a unit is 3e+07 Pa: steel has "
            "2.1e11 Pa; did you mean \"3e+07 psi\"?\n");
  const auto contact = [](const std::string& clearance, const std::string& friction) {
    return doubts(rotor("1", "0.1",
                        "[[contact]]\nat = 0\nclearance = " + clearance +
                            "\nstiffness = 1e6\nfriction = " + friction + "\n"));
  };
  EXPECT_EQ(contact("1e-4", "0.3"), "");
  EXPECT_EQ(contact("1e-4", "15"),
            "m:20:12: contact.1.friction: 15: dry steel has some 0.3, and 15 % are 0.15\n");
  EXPECT_EQ(
      contact("0.1", "0.3"),
      "m:18:13: contact.1.clearance: 0.1 without a unit is 0.1 m: those of machines are below "
      "20 mm; did you mean \"0.1 mm\" or \"0.1 mil\"?\n");
  EXPECT_EQ(
      doubts(rotor("1", "0.1", "[[unbalance]]\nat = 0\nmoment = 72\n")),
      "m:18:10: unbalance.1.moment: 72 without a unit is 72 kg.m: a blade lost at 1 m makes some "
      "5 kg.m; did you mean \"72 g.mm\" or \"72 g.cm\" or \"72 oz.in\"?\n");
  EXPECT_EQ(
      doubts(rotor("1", "0.1", "[operation]\nspeed = 7200\n")),
      "m:17:9: operation.speed: 7200 without a unit is 7200 rad/s = 68 755 rpm: 10 000 rpm are "
      "1047 rad/s; did you mean \"7200 rpm\"?\n");
}

// The range of a machine says which speeds it has, with a unit or without.
TEST(ValueDoubts, SpeedsFarOutsideOfTheMachinesOwnRange) {
  const auto at = [](const std::string& speed) {
    return doubts(rotor("1", "0.1",
                        "[operation]\nspeed = " + speed +
                            "\nminimum_speed = \"6000 rpm\"\nmaximum_speed = \"7560 rpm\"\n"));
  };
  EXPECT_EQ(at("\"7200 rpm\""), "");
  EXPECT_EQ(at("\"9000 rpm\""), "");  // tried beyond it
  EXPECT_EQ(at("\"72000 rpm\""),
            "m:17:9: operation.speed: the speed is 72 000 rpm, 9.52 times the largest of "
            "[operation], 7560 rpm; speeds without a unit are rad/s\n");
  EXPECT_EQ(at("\"120 rpm\""),
            "m:17:9: operation.speed: the speed is 120 rpm, 0.02 times the least of [operation], "
            "6000 rpm\n");
  EXPECT_NE(at("7200").find("did you mean \"7200 rpm\""), std::string::npos);
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

// A mass m on springs k sags by m g / k, here 10 mm: 8 mm more than the clearance, and none along
// +y.
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
