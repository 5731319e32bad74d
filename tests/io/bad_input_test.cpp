// Wrong models: every mistake is found, at its place, with what would be right.

#include <gtest/gtest.h>

#include "tests/io/problems.hpp"

namespace whirl::bad_input_test {

using test::joined, test::problems;

/// A model that is in order and has one of everything.
constexpr const char* good = R"(format = 1
[operation]
speed = "3000 rpm"
[material.steel]
density = "7800 kg/m^3"
youngs_modulus = "211 GPa"
shear_modulus = "81.2 GPa"
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
[[disk]]
name = "wheel"
at = "150 mm"
material = "steel"
outer_diameter = "300 mm"
inner_diameter = "20 mm"
width = "10 mm"
unbalance = { offset = "0.5 mm" }
[[body]]
name = "stator"
mass = "50 kg"
[[bearing]]
name = "left"
at = 0
stiffness = "4 MN/m"
[[bearing]]
name = "right"
at = "600 mm"
damping = "5 kN.s/m"
[[bearing]]
name = "mount"
body = "stator"
stiffness = "4 MN/m"
[[link]]
name = "strut"
from = "stator"
to = "ground"
stiffness = "1 MN/m"
[[unbalance]]
node = 3
moment = "1 kg.mm"
[[contact]]
name = "seal"
at = "300 mm"
against = "stator"
clearance = "5 mm"
stiffness = "3 MN/m"
friction = 0.1
[damping]
rayleigh = { mass = 1.0, stiffness = 1e-6 }
[reduction]
method = "modal"
modes = 8
[start]
from = "static"
whirl = [ { mode = 1, amplitude = "2 mm" } ]
)";

/// A mistake made in the good model, and the one line that is said about it.
struct Mistake {
  const char* of;       ///< in the good model, once
  const char* becomes;  ///< instead of it
  const char* place;    ///< line:column
  const char* key;
  const char* part;  ///< of the message
};

void expect_each(const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes) {
    std::string text = good;
    const auto at = text.find(mistake.of);
    ASSERT_NE(at, std::string::npos) << mistake.of;
    ASSERT_EQ(text.find(mistake.of, at + 1), std::string::npos) << "twice: " << mistake.of;
    text.replace(at, std::string(mistake.of).size(), mistake.becomes);
    const auto found = problems(text);
    SCOPED_TRACE(std::string(mistake.of) + " -> " + mistake.becomes + "\n" + joined(found));
    ASSERT_EQ(found.size(), 1u);
    const std::string start =
        std::string("m:") + mistake.place + ": " + mistake.key + (*mistake.key ? ": " : "");
    EXPECT_EQ(found[0].substr(0, start.size()), start);
    EXPECT_NE(found[0].find(mistake.part), std::string::npos) << mistake.part;
  }
}

TEST(BadInput, TheGoodModelIsGood) {
  EXPECT_EQ(joined(problems(good)), "");
}

TEST(BadInput, UnknownKeysInEveryTable) {
  expect_each({
      {"format = 1", "formt = 1", "1:1", "formt", "unknown key, did you mean \"format\"?"},
      {"[operation]", "[operatoin]", "2:2", "operatoin", "did you mean \"operation\"?"},
      {"format = 1", "format = 1\ngravty = 1", "2:1", "gravty", "did you mean \"gravity\"?"},
      {"speed =", "sped =", "3:1", "operation.sped", "did you mean \"speed\"?"},
      {"density =", "densty =", "5:1", "material.steel.densty", "did you mean \"density\"?"},
      {"length =", "lenght =", "10:1", "shaft.1.lenght", "did you mean \"length\"?"},
      {"width =", "widht =", "19:1", "disk.wheel.widht", "did you mean \"width\"?"},
      {"offset = \"0.5 mm\"", "offset = 1, fase = 2", "20:27", "disk.wheel.unbalance.fase",
       "did you mean \"phase\"?"},
      {"mass = \"50", "mas = \"50", "23:1", "body.stator.mas", "did you mean \"mass\"?"},
      {"damping = \"5", "dampin = \"5", "31:1", "bearing.right.dampin", "did you mean"},
      {"stiffness = \"1 MN", "stifness = \"1 MN", "40:1", "link.strut.stifness", "did you mean"},
      {"node = 3", "node = 3\nphas = 1", "43:1", "unbalance.1.phas", "did you mean \"phase\"?"},
      {"friction =", "frictoin =", "50:1", "contact.seal.frictoin", "did you mean \"friction\"?"},
      {"rayleigh =", "raleigh =", "52:1", "damping.raleigh", "did you mean \"rayleigh\"?"},
      {"stiffness = 1e-6", "stifness = 1e-6", "52:26", "damping.rayleigh.stifness",
       "did you mean \"stiffness\"?"},
      {"method =", "methd =", "54:1", "reduction.methd", "did you mean \"method\"?"},
      {"whirl =", "wirl =", "58:1", "start.wirl", "did you mean \"whirl\"?"},
      {"amplitude =", "amplitud =", "58:23", "start.whirl.1.amplitud", "did you mean"},
      {"width =", "zzz = 1\nwidth =", "19:1", "disk.wheel.zzz", "unknown key, known here: name, "},
  });
}

TEST(BadInput, MissingKeys) {
  expect_each({
      {"format = 1\n", "", "1:1", "format", "missing, expected a whole number"},
      {"density = \"7800 kg/m^3\"\n", "", "4:1", "material.steel.density", "a density (kg/m^3)"},
      {"shear_modulus = \"81.2 GPa\"\n", "", "4:1", "material.steel.shear_modulus",
       "missing, expected a shear modulus (Pa), or poisson_ratio"},
      {"material = \"steel\"\nlength", "length", "8:1", "shaft.1.material", "missing"},
      {"length = \"600 mm\"\n", "", "8:1", "shaft.1.length", "missing, expected a length (m)"},
      {"outer_diameter = \"20 mm\"\n", "", "8:1", "shaft.1.outer_diameter", "missing"},
      {"at = \"150 mm\"\n", "", "13:1", "disk.wheel.at",
       "missing, expected a station: at = position, node = number, or body = name"},
      {"width = \"10 mm\"\n", "", "13:1", "disk.wheel.width",
       "since the disk is given by its shape"},
      {"mass = \"50 kg\"\n", "", "21:1", "body.stator.mass", "missing, expected a mass (kg)"},
      {"damping = \"5 kN.s/m\"\n", "", "28:1", "bearing.right.stiffness",
       "missing, expected a stiffness (N/m), damping, rigid = true, clamped = true, or a table"},
      {"from = \"stator\"\n", "", "36:1", "link.strut.from", "missing, expected a body's name"},
      {"to = \"ground\"\n", "", "36:1", "link.strut.to", "missing, expected a body's name"},
      {"stiffness = \"1 MN/m\"\n", "", "36:1", "link.strut.stiffness", "missing"},
      {"node = 3\n", "", "41:1", "unbalance.1.at", "missing, expected a station"},
      {"clearance = \"5 mm\"\n", "", "44:1", "contact.seal.clearance", "missing"},
      {"stiffness = \"3 MN/m\"\n", "", "44:1", "contact.seal.stiffness", "missing"},
      {"mode = 1, ", "", "58:11", "start.whirl.1.mode", "missing, expected a whole number"},
      {"from = \"static\"", "from = \"file\"", "56:1", "start.file",
       "missing, expected the name of a result file to start from"},
      {"stiffness = \"4 MN/m\"\n[[link]]", "stiffness = { xx = 1, xy = 2 }\n[[link]]", "35:13",
       "bearing.mount.stiffness.yy", "missing, expected a stiffness (N/m)"},
  });
}

TEST(BadInput, ABodyWithoutAName) {
  EXPECT_EQ(problems("format = 1\n[[body]]\nmass = 1\n"),
            (std::vector<std::string>{"m:2:1: body.1.name: missing, expected a text"}));
  EXPECT_NE(
      problems("format = 1\n[[body]]\nname = \"\"\nmass = 1\n").at(0).find("a body needs a name"),
      std::string::npos);
  EXPECT_NE(problems("format = 1\n[[body]]\nname = \"ground\"\nmass = 1\n")
                .at(0)
                .find("choose another name"),
            std::string::npos);
}

TEST(BadInput, WrongTypes) {
  expect_each({
      {"format = 1", "format = \"1\"", "1:10", "format", "found \"1\", expected a whole number"},
      {"length = \"600 mm\"", "length = true", "10:10", "shaft.1.length",
       "found true, expected a length (m)"},
      {"length = \"600 mm\"", "length = [1, 2]", "10:10", "shaft.1.length", "found an array"},
      {"length = \"600 mm\"", "length = {}", "10:10", "shaft.1.length", "found a table"},
      {"length = \"600 mm\"", "length = 1979-05-27", "10:10", "shaft.1.length",
       "found a date or time"},
      {"elements = 12", "elements = \"12\"", "12:12", "shaft.1.elements",
       "expected a whole number"},
      {"elements = 12", "elements = 12.0", "12:12", "shaft.1.elements", "found 12.0, expected"},
      {"node = 3", "node = 3.5", "42:8", "unbalance.1.node", "found 3.5, expected a whole number"},
      {"name = \"wheel\"", "name = 5", "14:8", "disk.1.name", "expected a text in quotation marks"},
      {"unbalance = { offset = \"0.5 mm\" }", "unbalance = 5", "20:13", "disk.wheel.unbalance",
       "found 5, expected a table"},
      {"mass = \"50 kg\"", "mass = 50\nspins = 1", "24:9", "body.stator.spins",
       "found 1, expected true or false"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = [1, 2]", "27:13",
       "bearing.left.stiffness", "found an array"},
      {"to = \"ground\"", "to = 5", "39:6", "link.strut.to", "expected a text"},
      {"friction = 0.1", "offset = 5", "50:10", "contact.seal.offset", "found 5, expected [x, y]"},
      {"friction = 0.1", "offset = [1]", "50:10", "contact.seal.offset", "expected [x, y]"},
      {"{ mass = 1.0, stiffness = 1e-6 }", "1", "52:12", "damping.rayleigh", "expected a table"},
      {"[ { mode = 1, amplitude = \"2 mm\" } ]", "5", "58:9", "start.whirl",
       "found 5, expected [ {"},
      {"[ { mode = 1, amplitude = \"2 mm\" } ]", "[5]", "58:10", "start.whirl.1",
       "found 5, expected a table"},
      {"outer_diameter = \"20 mm\"", "outer_diameter = [1, 2, 3]", "11:18",
       "shaft.1.outer_diameter", "found a list of 3, expected one value, or [left, right]"},
  });
}

TEST(BadInput, TablesAndArraysOfTablesMixedUp) {
  EXPECT_EQ(
      problems("format = 1\n[shaft]\nlength = 1\n"),
      (std::vector<std::string>{"m:2:2: shaft: expected an array of tables: write [[shaft]]"}));
  expect_each({
      {"[operation]", "[[operation]]", "2:1", "operation", "expected a table: write [operation]"},
      {"[[disk]]", "[disk]", "13:2", "disk", "expected an array of tables: write [[disk]]"},
      {"[[link]]", "[link]", "36:2", "link", "expected an array of tables: write [[link]]"},
      {"[damping]", "[[damping]]", "51:1", "damping", "expected a table: write [damping]"},
      {"[reduction]", "[[reduction]]", "53:1", "reduction", "expected a table: write [reduction]"},
      {"[start]", "[[start]]", "56:1", "start", "expected a table: write [start]"},
  });
  EXPECT_EQ(problems("format = 1\n[[material]]\n[[body]]\nname = \"m\"\nmass = 1\n").at(0),
            "m:2:1: material: expected tables with names: write [material.steel]");
  EXPECT_EQ(problems("format = 1\nshaft = [1]\n"),
            (std::vector<std::string>{"m:2:10: shaft.1: found 1, expected a table"}));
}

TEST(BadInput, UnitsOfAnotherDimension) {
  expect_each({
      {"speed = \"3000 rpm\"", "speed = \"3000 1/s\"", "3:9", "operation.speed",
       "found \"3000 1/s\", expected a speed (rad/s)"},
      {"length = \"600 mm\"", "length = \"600 kg\"", "10:10", "shaft.1.length",
       "found \"600 kg\", expected a length (m)"},
      {"length = \"600 mm\"", "length = \"600 mmm\"", "10:10", "shaft.1.length",
       "did you mean \"mm\"?"},
      {"length = \"600 mm\"", "length = \"six\"", "10:10", "shaft.1.length", "is not a number"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = \"4 MN/mm^2\"", "27:13",
       "bearing.left.stiffness", "found \"4 MN/mm^2\", expected a stiffness (N/m)"},
      {"moment = \"1 kg.mm\"", "moment = \"1 kg\"", "43:10", "unbalance.1.moment",
       "found \"1 kg\", expected an unbalance (kg.m)"},
      {"mass = 1.0,", "mass = \"1 kg\",", "52:21", "damping.rayleigh.mass",
       "expected a rate (1/s)"},
      {"friction = 0.1", "friction = \"0.1 m\"", "50:12", "contact.seal.friction",
       "expected a number without unit"},
      {"{ offset = \"0.5 mm\" }", "{ offset = 1, phase = \"1 m\" }", "20:35",
       "disk.wheel.unbalance.phase", "expected an angle (rad)"},
  });
}

TEST(BadInput, NumbersOutOfRange) {
  expect_each({
      {"format = 1", "format = 2", "1:10", "format", "found 2, expected 1, the only format so far"},
      {"speed = \"3000 rpm\"", "speed = \"-1 rpm\"", "3:9", "operation.speed", "of zero or more"},
      {"length = \"600 mm\"", "length = -0.6", "10:10", "shaft.1.length",
       "found -0.6, expected a length (m) above zero"},
      {"length = \"600 mm\"", "length = 0", "10:10", "shaft.1.length", "above zero"},
      {"length = \"600 mm\"", "length = nan", "10:10", "shaft.1.length", "found nan"},
      {"length = \"600 mm\"", "length = inf", "10:10", "shaft.1.length", "found inf"},
      {"length = \"600 mm\"", "length = \"nan\"", "10:10", "shaft.1.length", "is not a number"},
      {"length = \"600 mm\"", "length = \"1e999 m\"", "10:10", "shaft.1.length",
       "beyond the range of numbers"},
      {"elements = 12", "elements = 1e9", "12:12", "shaft.1.elements", "expected a whole number"},
      {"elements = 12", "elements = 1000000000", "12:12", "shaft.1.elements",
       "found 1000000000, expected a number up to 100000"},
      {"elements = 12", "elements = 9000000000000000000", "12:12", "shaft.1.elements",
       "expected a number up to 1000000000"},
      {"elements = 12", "elements = 0", "12:12", "shaft.1.elements",
       "found 0, expected a whole number above zero"},
      {"elements = 12", "elements = -3", "12:12", "shaft.1.elements", "above zero"},
      {"elements = 12", "elements = 12\ninternal_functions = 5", "13:22",
       "shaft.1.internal_functions", "found 5, expected a number up to 4"},
      {"elements = 12", "elements = 12\nshear_coefficient = -1", "13:21",
       "shaft.1.shear_coefficient", "above zero"},
      {"elements = 12", "elements = 12\ninner_diameter = \"21 mm\"", "13:18",
       "shaft.1.inner_diameter", "found 21 mm, expected less than the outer diameter of 20 mm"},
      {"elements = 12", "elements = 12\ninner_diameter = [0, \"20 mm\"]", "13:18",
       "shaft.1.inner_diameter", "expected less than the outer diameter"},
      {"inner_diameter = \"20 mm\"", "inner_diameter = \"400 mm\"", "18:18",
       "disk.wheel.inner_diameter", "expected less than the outer diameter of 300 mm"},
      {"mass = \"50 kg\"", "mass = \"-50 kg\"", "23:8", "body.stator.mass",
       "found \"-50 kg\", expected a mass (kg) of zero or more"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = -1", "27:13",
       "bearing.left.stiffness", "of zero or more"},
      {"clearance = \"5 mm\"", "clearance = 0", "48:13", "contact.seal.clearance", "above zero"},
      {"friction = 0.1", "friction = -0.1", "50:12", "contact.seal.friction", "of zero or more"},
      {"modes = 8", "modes = 0", "55:9", "reduction.modes",
       "found 0, expected a whole number above"},
      {"mode = 1,", "mode = 0,", "58:20", "start.whirl.1.mode", "above zero"},
      {"shear_modulus = \"81.2 GPa\"", "poisson_ratio = 0.6", "7:17",
       "material.steel.poisson_ratio", "Poisson's ratio is 0.6, expected -1 to 0.5"},
      {"shear_modulus = \"81.2 GPa\"", "shear_modulus = \"10 GPa\"", "7:17",
       "material.steel.shear_modulus", "Poisson's ratio is 9.55, expected -1 to 0.5"},
      {"shear_modulus = \"81.2 GPa\"", "shear_modulus = \"81.2 GPa\"\npoisson_ratio = 0.25", "8:17",
       "material.steel.poisson_ratio", "does not fit youngs_modulus and shear_modulus"},
  });
}

// Each law has keys of its own.
TEST(BadInput, KeysOfAnotherLaw) {
  expect_each({
      {"stiffness = \"3 MN/m\"\nfriction", "law = \"hertz\"\nfriction", "44:1",
       "contact.seal.hertz_stiffness", "missing, expected a Hertz stiffness (N/m^1.5)"},
      {"friction = 0.1", "hertz_stiffness = 1e9", "50:1", "contact.seal.hertz_stiffness",
       "unknown"},
      {"friction = 0.1", "dissipation = 0.5", "50:1", "contact.seal.dissipation", "unknown"},
      {"stiffness = \"3 MN/m\"\nfriction = 0.1",
       "law = \"hertz\"\nhertz_stiffness = 1e9\ndissipation = -0.5", "51:15",
       "contact.seal.dissipation", "found -0.5"},
      {"stiffness = \"3 MN/m\"\nfriction = 0.1",
       "law = \"hertz\"\nhertz_stiffness = 1e9\ndissipation = \"0.5 m/s\"", "51:15",
       "contact.seal.dissipation", "expected a dissipation factor (s/m)"},
  });
}

TEST(BadInput, WordsThatAreNotOnes) {
  expect_each({
      {"elements = 12", "elements = 12\ntheory = \"timoschenko\"", "13:10", "shaft.1.theory",
       "expected one of timoshenko, rayleigh, euler-bernoulli; did you mean \"timoshenko\"?"},
      {"elements = 12", "elements = 12\nshear_coefficient = \"cowpr\"", "13:21",
       "shaft.1.shear_coefficient", "did you mean \"cowper\"?"},
      {"friction = 0.1", "law = \"radal\"", "50:7", "contact.seal.law", "did you mean \"radial\"?"},
      {"friction = 0.1", "law = \"herz\"", "50:7", "contact.seal.law",
       "expected one of radial, hertz, line, face, blade-tip; did you mean \"hertz\"?"},
      {"friction = 0.1", "slip = \"actal\"", "50:8", "contact.seal.slip",
       "expected one of actual, forward; did you mean \"actual\"?"},
      {"method = \"modal\"", "method = \"modl\"", "54:10", "reduction.method",
       "did you mean \"modal\"?"},
      {"from = \"static\"", "from = \"sttic\"", "57:8", "start.from",
       "expected one of rest, static, file; did you mean \"static\"?"},
  });
}

TEST(BadInput, NamesThatStandForNothing) {
  expect_each({
      {"material = \"steel\"\nlength", "material = \"stel\"\nlength", "9:12", "shaft.1.material",
       "found \"stel\", expected steel; did you mean \"steel\"?"},
      {"body = \"stator\"", "body = \"statr\"", "34:8", "bearing.mount.body",
       "expected stator; did you mean \"stator\"?"},
      {"body = \"stator\"", "body = \"ground\"", "34:8", "bearing.mount.body", "expected stator"},
      {"against = \"stator\"", "against = \"sttor\"", "47:11", "contact.seal.against",
       "expected one of ground, stator; did you mean \"stator\"?"},
      {"to = \"ground\"", "to = \"gruond\"", "39:6", "link.strut.to", "did you mean \"ground\"?"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = 1\nto = \"casing\"", "28:6",
       "bearing.left.to", "found \"casing\", expected one of ground, stator"},
  });
  EXPECT_EQ(problems("format = 1\n[material.steel]\ndensity = 1\nyoungs_modulus = 1\n"
                     "poisson_ratio = 0\n[[shaft]]\nmaterial = \"steel\"\nlength = 1\n"
                     "outer_diameter = 1\n[[disk]]\nbody = \"b\"\nmass = 1\n"),
            (std::vector<std::string>{
                "m:11:8: disk.1.body: found \"b\", but the model has no [[body]]"}));
  EXPECT_EQ(
      problems("format = 1\n[[shaft]]\nmaterial = \"steel\"\nlength = 1\nouter_diameter = 1\n"),
      (std::vector<std::string>{"m:3:12: shaft.1.material: there is no [material.steel]"}));
}

TEST(BadInput, Stations) {
  expect_each({
      {"at = \"150 mm\"", "at = \"900 mm\"", "15:6", "disk.wheel.at",
       "900 mm is off the shaft; the shaft reaches from 0 to 600 mm"},
      {"at = \"150 mm\"", "at = \"-1 mm\"", "15:6", "disk.wheel.at", "-1 mm is off the shaft"},
      {"at = \"150 mm\"", "node = 14", "15:8", "disk.wheel.node",
       "found node 14, expected a node from 1 to 13"},
      {"at = \"150 mm\"", "node = 0", "15:8", "disk.wheel.node", "above zero"},
      {"at = \"150 mm\"", "at = \"150 mm\"\nnode = 5", "15:6", "disk.wheel.at",
       "150 mm and node 5, which is at 200 mm, are different places; give one"},
      {"at = \"150 mm\"", "at = \"150 mm\"\nnode = 99", "15:6", "disk.wheel.at",
       "found node 99, expected a node from 1 to 13"},
      {"at = \"150 mm\"", "at = \"150.0001 mm\"", "15:6", "disk.wheel.at",
       "150.0001 mm and 150 mm are the same place with different numbers"},
      {"at = \"150 mm\"", "at = \"150 mm\"\nbody = \"stator\"", "16:8", "disk.wheel.body",
       "found a body and a place on the shaft, expected one of them"},
      {"at = \"150 mm\"", "body = \"stator\"", "15:8", "disk.wheel.body",
       "a disk sits on the shaft"},
      {"at = \"150 mm\"", "body = \"ground\"", "15:8", "disk.wheel.body", "expected stator"},
      {"node = 3", "body = \"stator\"", "42:8", "unbalance.1.body",
       "this body does not spin and has no unbalance; give it spins = true"},
      {"node = 3", "body = \"ground\"", "42:8", "unbalance.1.body", "expected stator"},
      {"to = \"ground\"", "to = { at = 5 }", "39:13", "link.strut.to.at",
       "5000 mm is off the shaft"},
      {"to = \"ground\"", "to = { nod = 5 }", "39:8", "link.strut.to.nod",
       "did you mean \"node\"?"},
  });
  EXPECT_EQ(
      problems("format = 1\n[[body]]\nname = \"m\"\nmass = 1\n[[bearing]]\nat = 1\n"
               "stiffness = 1\n"),
      (std::vector<std::string>{"m:6:6: bearing.1.at: 1000 mm is off the shaft; the model has "
                                "no shaft: name a body instead"}));
}

TEST(BadInput, ThingsThatContradict) {
  expect_each({
      {"name = \"right\"", "name = \"left\"", "29:8", "bearing.left.name",
       "another bearing has this name already"},
      {"width = \"10 mm\"", "width = \"10 mm\"\nmass = 1", "20:8", "disk.wheel.mass",
       "one of the two"},
      {"material = \"steel\"\nouter_diameter = \"300 mm\"", "outer_diameter = \"300 mm\"", "13:1",
       "disk.wheel.material", "expected a disk by its shape"},
      {"width = \"10 mm\"", "width = \"10 mm\"\npolar_inertia = 1", "20:17",
       "disk.wheel.polar_inertia", "follows from the shape"},
      {"{ offset = \"0.5 mm\" }", "{ offset = 1, moment = 1 }", "20:24",
       "disk.wheel.unbalance.offset", "expected one of moment (kg.m) and offset"},
      {"{ offset = \"0.5 mm\" }", "{ phase = 1 }", "20:13", "disk.wheel.unbalance.moment",
       "expected one of moment (kg.m) and offset"},
      {"moment = \"1 kg.mm\"", "offset = \"1 mm\"", "43:10", "unbalance.1.offset",
       "an offset needs a mass: give moment (kg.m) instead"},
      {"mass = \"50 kg\"", "mass = 50\npolar_inertia = 1", "24:17", "body.stator.polar_inertia",
       "only a body with tilts = true"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nrigid = true\nstiffness = 1", "27:9",
       "bearing.left.rigid", "a rigid bearing has no stiffness or damping of its own"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nrigid = true\n[[bearing]]\nat = 0\nrigid = true",
       "28:1", "bearing.bearing 2", "its ends are held together already"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nclamped = true\nto = \"stator\"", "24:1",
       "bearing.left", "cannot clamp to a body without tilts; give it tilts = true"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = 1\ntable = \"speed,kxx\\n1,2\"",
       "28:9", "bearing.left.table", "found a table and coefficients, expected one of them"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = 1\ninterpolation = \"pchip\"",
       "28:17", "bearing.left.interpolation", "belongs to a table, which is missing"},
      {"at = 0\nstiffness = \"4 MN/m\"",
       "at = 0\ntable = \"speed,kxx\\n1,2\"\ninterpolation = \"cubic\"", "28:17",
       "bearing.left.interpolation", "expected one of linear, pchip"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nadded_mass = \"4 N\"", "27:14",
       "bearing.left.added_mass", "expected a mass (kg)"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nstiffness = 1\n[[seal]]\nat = 0\nstifness = 2",
       "30:1", "seal.1.stifness", "did you mean \"stiffness\"?"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nkind = \"tabel\"\nstiffness = 1", "27:8",
       "bearing.left.kind", "expected one of constant, table; did you mean \"table\"?"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nkind = \"table\"", "24:1", "bearing.left.table",
       "missing, expected a file with coefficients against speed (CSV)"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nkind = \"constant\"", "24:1",
       "bearing.left.stiffness",
       "missing, expected one of stiffness, damping, tilt_stiffness, tilt_damping, added_mass"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\nkind = \"constant\"\nrigid = true", "27:8",
       "bearing.left.kind", "a rigid bearing has no coefficients of its own; leave out the kind"},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\ntable = \"nothing.csv\"", "27:9",
       "bearing.left.table", "cannot read the file \"nothing.csv\""},
      {"at = 0\nstiffness = \"4 MN/m\"", "at = 0\ntable = \".\"", "27:9", "bearing.left.table",
       "cannot read the file"},
      {"to = \"ground\"", "to = \"stator\"", "36:1", "link.strut",
       "both ends are at the same place"},
      {"at = \"300 mm\"", "body = \"stator\"\nradius = 1", "48:11", "contact.seal.against",
       "the body would touch itself"},
  });
}

TEST(BadInput, AModelNeedsARotorWithMass) {
  EXPECT_EQ(
      problems("format = 1\n"),
      (std::vector<std::string>{"m:1:1: shaft: missing: a model needs a [[shaft]] or a [[body]]"}));
  EXPECT_NE(problems("format = 1\n[[body]]\nname = \"m\"\nmass = 0\n").at(0).find("has a mass"),
            std::string::npos);
}

TEST(BadInput, AllMistakesOfAFileInOneGoAndInItsOrder) {
  std::string text = good;
  const auto make = [&](const std::string& of, const std::string& becomes) {
    text.replace(text.find(of), of.size(), becomes);
  };
  make("whirl =", "wirl =");
  make("length = \"600 mm\"", "length = \"600 kg\"");
  make("mass = \"50 kg\"", "mass = -1");
  make("speed =", "sped =");
  make("friction = 0.1", "friction = \"much\"");
  make("name = \"right\"", "name = \"left\"");
  EXPECT_EQ(
      problems(text),
      (std::vector<std::string>{
          "m:3:1: operation.sped: unknown key, did you mean \"speed\"?",
          "m:10:10: shaft.1.length: found \"600 kg\", expected a length (m)",
          "m:23:8: body.stator.mass: found -1, expected a mass (kg) of zero or more",
          "m:29:8: bearing.left.name: another bearing has this name already",
          "m:50:12: contact.seal.friction: \"much\" is not a number, expected a number without "
          "unit",
          "m:58:1: start.wirl: unknown key, did you mean \"whirl\"?"}));
}

TEST(BadInput, MistakesOfTheCommandLineComeFirstAndThoseOfTablesLast) {
  try {
    parse_model(
        "format = 1\n[[body]]\nname = \"m\"\nmass = 1\n[[bearing]]\nbody = \"m\"\n"
        "table = \"speed,kxx\\n1,x\"\n[[unbalance]]\nbody = \"m\"\nmoment = -1\n",
        "m", {"gravity=down"});
    FAIL();
  } catch (const ModelError& error) {
    ASSERT_EQ(error.problems().size(), 4u) << error.what();
    EXPECT_EQ(error.problems()[0].where.file, "--set gravity=down");
    EXPECT_EQ(error.problems()[1].where, (Where{"m", 9, 8}));  // the body does not spin
    EXPECT_EQ(error.problems()[2].where, (Where{"m", 10, 10}));
    EXPECT_EQ(error.problems()[3].where, (Where{"m:7: bearing.1.table", 2, 3}));
  }
}

}  // namespace whirl::bad_input_test
