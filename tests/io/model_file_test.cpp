// Model files: every key arrives where it belongs, in SI.

#include "libio/model/model_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "libfe/assembly/assemble.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::model_file_test {

namespace fs = std::filesystem;
using test::rotor;

constexpr double pi = std::numbers::pi;
constexpr double rpm = pi / 30.0;

/// A shaft of one segment with further keys.
Segment segment(const std::string& keys) {
  const Model model = parse_model(R"(
format = 1
[material.steel]
density = 7800
youngs_modulus = 211e9
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 0.6
)" + keys);
  return model.structure.shaft.at(0);
}

TEST(ModelFile, TopOfTheFile) {
  const Model model = parse_model(R"(
format = 1
title = "Rotor"
gravity = "9.81 m/s^2"
[operation]
speed = "3650 rpm"
[[body]]
name = "mass"
mass = 1
)",
                                  "rotor.toml");
  EXPECT_EQ(model.title, "Rotor");
  EXPECT_EQ(model.structure.gravity, 9.81);
  EXPECT_DOUBLE_EQ(model.speed, 3650.0 * rpm);
  EXPECT_TRUE(model.has_speed);
  EXPECT_EQ(model.path, "rotor.toml");
}

TEST(ModelFile, WhatIsLeftOutHasItsDefault) {
  const Model model = rotor();
  EXPECT_EQ(model.structure.gravity, 0.0);
  EXPECT_FALSE(model.has_speed);
  EXPECT_EQ(model.structure.damping.mass, 0.0);
  EXPECT_EQ(model.structure.damping.stiffness, 0.0);
  EXPECT_EQ(model.reduction.method, ReductionMethod::automatic);
  EXPECT_EQ(model.reduction.modes, 0);
  EXPECT_EQ(model.reduction.tolerance, 1e-3);
  EXPECT_EQ(model.start.from, StartFrom::equilibrium);
  EXPECT_TRUE(model.start.whirl.empty());
  const Segment& s = model.structure.shaft[0];
  EXPECT_EQ(s.theory, Theory::timoshenko);
  EXPECT_EQ(s.shear.formula, ShearFormula::cowper);
  EXPECT_EQ(s.left.inner, 0.0);
  EXPECT_EQ(s.axial_force, 0.0);
  EXPECT_EQ(s.torque, 0.0);
}

TEST(ModelFile, Speeds) {
  const auto speed = [](const std::string& text) {
    return rotor("[operation]\nspeed = " + text + "\n").speed;
  };
  EXPECT_DOUBLE_EQ(speed("\"3650 rpm\""), 3650.0 * rpm);
  EXPECT_DOUBLE_EQ(speed("\"100 rad/s\""), 100.0);
  EXPECT_DOUBLE_EQ(speed("\"50 Hz\""), 100.0 * pi);
  EXPECT_DOUBLE_EQ(speed("\"180 deg/s\""), pi);
  EXPECT_DOUBLE_EQ(speed("100"), 100.0);  // a bare number is SI
  EXPECT_DOUBLE_EQ(speed("\"100\""), 100.0);
}

// None of them is above the next one; those that are left out are not told.
TEST(ModelFile, SpeedsOfTheMachine) {
  const MachineSpeeds none = rotor("[operation]\nspeed = 100\n").machine;
  EXPECT_EQ(none.minimum, 0.0);
  EXPECT_EQ(none.trip, 0.0);
  const std::string text =
      "[operation]\nminimum_speed = \"3650 rpm\"\nmaximum_speed = 500\ntrip_speed = 600\n";
  const Model model = rotor(text);
  EXPECT_DOUBLE_EQ(model.machine.minimum, 3650.0 * rpm);
  EXPECT_EQ(model.machine.maximum, 500.0);
  EXPECT_EQ(model.machine.trip, 600.0);
  EXPECT_FALSE(model.has_speed);
  const auto problem = [&](const std::string& set) -> std::string {
    try {
      parse_model(model.source, "model", {set});
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(problem("operation.maximum_speed=700").find("is above trip_speed"), std::string::npos);
  EXPECT_NE(problem("operation.minimum_speed=550").find("is above maximum_speed"),
            std::string::npos);
  EXPECT_NE(problem("operation.trip_speed=0"), "none");
  EXPECT_EQ(problem("operation.trip_speed=500"), "none");
}

// ---- materials ----

TEST(ModelFile, MaterialByShearModulus) {
  const Material m = rotor().structure.shaft[0].material;
  EXPECT_EQ(m.name, "steel");
  EXPECT_EQ(m.rho, 7800.0);
  EXPECT_EQ(m.E, 211e9);
  EXPECT_EQ(m.G, 81.2e9);
  EXPECT_DOUBLE_EQ(m.nu, 211.0 / (2.0 * 81.2) - 1.0);
  EXPECT_EQ(m.eta, 0.0);
}

TEST(ModelFile, MaterialByPoissonRatio) {
  const Material m = segment("outer_diameter = 0.02\n").material;
  EXPECT_EQ(m.nu, 0.3);
  EXPECT_DOUBLE_EQ(m.G, 211e9 / 2.6);
}

TEST(ModelFile, MaterialByBothThatAgreeAndInternalDamping) {
  const Model model = parse_model(R"(
format = 1
[material.m]
density = "7.8 g/cm^3"
youngs_modulus = "26 GPa"
shear_modulus = "10 GPa"
poisson_ratio = 0.3
internal_damping = "2 us"
[[shaft]]
material = "m"
length = 1
outer_diameter = 0.1
)");
  const Material& m = model.structure.shaft[0].material;
  EXPECT_DOUBLE_EQ(m.rho, 7800.0);
  EXPECT_EQ(m.G, 10e9);
  EXPECT_EQ(m.nu, 0.3);
  EXPECT_DOUBLE_EQ(m.eta, 2e-6);
}

// ---- shaft ----

TEST(ModelFile, Cylinder) {
  const Segment s = segment("outer_diameter = \"2 in\"\ninner_diameter = \"1 in\"\nelements = 7\n");
  EXPECT_EQ(s.length, 0.6);
  EXPECT_EQ(s.elements, 7);
  EXPECT_EQ(s.left.outer, 0.0508);
  EXPECT_EQ(s.right.outer, 0.0508);
  EXPECT_EQ(s.left.inner, 0.0254);
  EXPECT_EQ(s.right.inner, 0.0254);
}

TEST(ModelFile, Cone) {
  const Segment s =
      segment("outer_diameter = [\"20 mm\", 0.04]\ninner_diameter = [0, \"10 mm\"]\n");
  EXPECT_EQ(s.left.outer, 0.02);
  EXPECT_EQ(s.right.outer, 0.04);
  EXPECT_EQ(s.left.inner, 0.0);
  EXPECT_EQ(s.right.inner, 0.01);
}

TEST(ModelFile, SegmentsFollowOneAnother) {
  const Model model = rotor(
      "[[shaft]]\nname = \"end\"\nmaterial = \"steel\"\nlength = 0.4\n"
      "outer_diameter = 0.03\nelements = 2\n");
  EXPECT_DOUBLE_EQ(model.structure.length(), 1.0);
  EXPECT_EQ(Assembler(model.structure).mesh().nodes(), 15);
}

TEST(ModelFile, TheoriesAndShearCoefficients) {
  const std::string d = "outer_diameter = 0.02\n";
  EXPECT_EQ(segment(d + "theory = \"timoshenko\"\n").theory, Theory::timoshenko);
  EXPECT_EQ(segment(d + "theory = \"rayleigh\"\n").theory, Theory::rayleigh);
  EXPECT_EQ(segment(d + "theory = \"euler-bernoulli\"\n").theory, Theory::euler_bernoulli);
  const auto shear = [&](const std::string& value) {
    return segment(d + "shear_coefficient = " + value + "\n").shear;
  };
  EXPECT_EQ(shear("\"cowper\"").formula, ShearFormula::cowper);
  EXPECT_EQ(shear("\"hutchinson\"").formula, ShearFormula::hutchinson);
  EXPECT_EQ(shear("0.9").formula, ShearFormula::given);
  EXPECT_EQ(shear("0.9").value, 0.9);
}

TEST(ModelFile, AxialForceTorqueAndInternalFunctions) {
  const Segment s = segment(
      "outer_diameter = 0.02\naxial_force = \"-3 kN\"\ntorque = \"2 N.m\"\n"
      "internal_functions = 3\n");
  EXPECT_EQ(s.axial_force, -3000.0);
  EXPECT_EQ(s.torque, 2.0);
  EXPECT_EQ(s.internal_functions, 3);
}

// ---- disks and bodies ----

// m = rho pi w (do^2 - di^2) / 4, Ip = m (do^2 + di^2) / 8, Id = Ip / 2 + m w^2 / 12
TEST(ModelFile, DiskByShape) {
  const Disk d = rotor(R"(
[[disk]]
name = "wheel"
at = "150 mm"
material = "steel"
outer_diameter = "300 mm"
inner_diameter = "20 mm"
width = "10 mm"
)")
                     .structure.disks.at(0);
  const double m = 7800.0 * pi * 0.01 * (0.09 - 0.0004) / 4.0;
  const double Ip = m * (0.09 + 0.0004) / 8.0;
  EXPECT_EQ(d.name, "wheel");
  EXPECT_EQ(d.at.kind, Station::Kind::position);
  EXPECT_EQ(d.at.z, 0.15);
  EXPECT_NEAR(d.m, m, 1e-14 * m);
  EXPECT_NEAR(d.Ip, Ip, 1e-14 * Ip);
  EXPECT_NEAR(d.Id, Ip / 2.0 + m * 1e-4 / 12.0, 1e-14 * Ip);
  EXPECT_EQ(d.width, 0.01);
}

TEST(ModelFile, DiskByMass) {
  const Disk d = rotor(R"(
[[disk]]
node = 4
mass = "5.5 kg"
diametral_inertia = "0.03 kg.m^2"
polar_inertia = "600 kg.cm^2"
)")
                     .structure.disks.at(0);
  EXPECT_EQ(d.name, "disk 1");
  EXPECT_EQ(d.at.kind, Station::Kind::node);
  EXPECT_EQ(d.at.node, 4);
  EXPECT_EQ(d.m, 5.5);
  EXPECT_EQ(d.Id, 0.03);
  EXPECT_DOUBLE_EQ(d.Ip, 0.06);
}

TEST(ModelFile, Bodies) {
  const Model model = parse_model(R"(
format = 1
[[body]]
name = "stator"
mass = "50 kg"
[[body]]
name = "wheel"
mass = "2 t"
spins = true
tilts = true
diametral_inertia = 3
polar_inertia = 4
)");
  const auto& bodies = model.structure.bodies;
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].name, "stator");
  EXPECT_EQ(bodies[0].m.x, 50.0);
  EXPECT_FALSE(bodies[0].spins);
  EXPECT_FALSE(bodies[0].tilts);
  EXPECT_EQ(bodies[1].m.x, 2000.0);
  EXPECT_TRUE(bodies[1].spins);
  EXPECT_TRUE(bodies[1].tilts);
  EXPECT_EQ(bodies[1].Id, 3.0);
  EXPECT_EQ(bodies[1].Ip, 4.0);
}

TEST(ModelFile, UnbalancesInBothForms) {
  const Model model = rotor(R"(
[[disk]]
node = 4
mass = 5
unbalance = { offset = "0.5 mm", phase = "90 deg" }
[[disk]]
node = 5
mass = 5
unbalance = { moment = "1 kg.mm" }
[[unbalance]]
at = "300 mm"
moment = "20 g.mm"
phase = -1.5
[[unbalance]]
body = "wheel"
offset = "1 mm"
phase = "180 deg"
[[body]]
name = "wheel"
mass = 3
spins = true
)");
  const auto& u = model.structure.unbalances;
  ASSERT_EQ(u.size(), 4u);
  EXPECT_DOUBLE_EQ(u[0].moment, 5.0 * 0.5e-3);
  EXPECT_DOUBLE_EQ(u[0].phase, pi / 2.0);
  EXPECT_EQ(u[0].at.node, 4);
  EXPECT_DOUBLE_EQ(u[1].moment, 1e-3);
  EXPECT_EQ(u[1].phase, 0.0);
  EXPECT_DOUBLE_EQ(u[2].moment, 2e-5);
  EXPECT_EQ(u[2].phase, -1.5);
  EXPECT_EQ(u[2].at.z, 0.3);
  EXPECT_DOUBLE_EQ(u[3].moment, 3e-3);
  EXPECT_DOUBLE_EQ(u[3].phase, pi);
  EXPECT_EQ(u[3].at.body, "wheel");
}

// ---- settings ----

TEST(ModelFile, DampingReductionAndStart) {
  const Model model = rotor(R"(
[damping]
rayleigh = { mass = "2 1/s", stiffness = "3 us" }
[reduction]
method = "modal+residual"
modes = 8
tolerance = 1e-4
band = "6000 rpm"
[start]
from = "rest"
whirl = [ { mode = 1, amplitude = "2 mm", phase = "90 deg" }, { mode = 3, amplitude = 1e-3 } ]
)");
  EXPECT_EQ(model.structure.damping.mass, 2.0);
  EXPECT_DOUBLE_EQ(model.structure.damping.stiffness, 3e-6);
  EXPECT_EQ(model.reduction.method, ReductionMethod::modal_residual);
  EXPECT_EQ(model.reduction.modes, 8);
  EXPECT_EQ(model.reduction.tolerance, 1e-4);
  EXPECT_DOUBLE_EQ(model.reduction.band, 6000.0 * rpm);
  EXPECT_EQ(model.start.from, StartFrom::rest);
  ASSERT_EQ(model.start.whirl.size(), 2u);
  EXPECT_EQ(model.start.whirl[0].mode, 1);
  EXPECT_EQ(model.start.whirl[0].amplitude, 2e-3);
  EXPECT_DOUBLE_EQ(model.start.whirl[0].phase, pi / 2.0);
  EXPECT_EQ(model.start.whirl[1].mode, 3);
  EXPECT_EQ(model.start.whirl[1].phase, 0.0);
}

TEST(ModelFile, ReductionMethodsAndStarts) {
  const auto method = [](const std::string& name) {
    return rotor("[reduction]\nmethod = \"" + name + "\"\n").reduction.method;
  };
  EXPECT_EQ(method("modal"), ReductionMethod::modal);
  EXPECT_EQ(method("modal+residual"), ReductionMethod::modal_residual);
  EXPECT_EQ(method("damped"), ReductionMethod::damped);
  EXPECT_EQ(method("none"), ReductionMethod::none);
  EXPECT_EQ(rotor("[start]\nfrom = \"static\"\n").start.from, StartFrom::equilibrium);
  const Model model = rotor("[start]\nfrom = \"file\"\nfile = \"run.h5\"\n");
  EXPECT_EQ(model.start.from, StartFrom::file);
  EXPECT_EQ(model.start.file, "run.h5");
}

TEST(ModelFile, AStartFileLiesBesideTheModelOrWhereTheShellSays) {
  const std::string text =
      "format = 1\n[[body]]\nname = \"m\"\nmass = 1\n[start]\nfrom = \"file\"\nfile = \"run.h5\"\n";
  EXPECT_EQ(parse_model(text, "m", {}, "there").start.file, fs::path("there/run.h5"));
  EXPECT_EQ(parse_model(text, "m", {"start.file=other.h5"}, "there").start.file, "other.h5");
}

// ---- stations ----

TEST(ModelFile, StationsByPlaceByNodeByBothAndByBody) {
  const Model model = rotor(R"(
[[body]]
name = "wheel"
mass = 1
[[bearing]]
at = "100 mm"
stiffness = 1
[[bearing]]
node = 3
stiffness = 1
[[bearing]]
at = "100 mm"
node = 3
stiffness = 1
[[bearing]]
body = "wheel"
stiffness = 1
)");
  const Assembler assembler(model.structure);
  const Point third{Point::Kind::node, 2};
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_EQ(assembler.point(model.structure.bearings[i].from), third) << i;
  }
  EXPECT_EQ(assembler.point(model.structure.bearings[3].from), (Point{Point::Kind::body, 0}));
}

/// Two shafts, the second of 0.4 m from 0.1 m on, with further tables.
std::string two_shafts(const std::string& more) {
  return R"(
format = 1
[operation]
speed = 100
[material.steel]
density = 7800
youngs_modulus = 211e9
poisson_ratio = 0.3
[[rotor]]
name = "hp"
ratio = 1.5
position = "100 mm"
[[shaft]]
material = "steel"
length = 0.6
outer_diameter = 0.02
[[shaft]]
rotor = "hp"
material = "steel"
length = 0.4
outer_diameter = 0.06
inner_diameter = 0.04
[[bearing]]
at = 0
stiffness = 1e6
[[bearing]]
rotor = "hp"
at = 0.1
to = "shaft"
stiffness = 1e6
)" + more;
}

TEST(ModelFile, FurtherShafts) {
  const Model model = parse_model(two_shafts(R"(
[[disk]]
rotor = "hp"
at = 0.3
mass = 2
unbalance = { moment = 1e-5 }
[[body]]
name = "ring"
mass = 1
spins = true
rotor = "hp"
[[contact]]
at = 0.3
against = "hp"
clearance = 1e-3
stiffness = 1e6
)"));
  const Structure& s = model.structure;
  ASSERT_EQ(s.rotors.size(), 1u);
  EXPECT_EQ(s.rotors[0].ratio, 1.5);
  EXPECT_EQ(s.rotors[0].z, 0.1);
  ASSERT_EQ(s.rotors[0].shaft.size(), 1u);
  EXPECT_EQ(s.rotors[0].shaft[0].length, 0.4);
  EXPECT_EQ(s.shaft.size(), 1u);
  EXPECT_EQ(s.disks[0].at.rotor, "hp");
  EXPECT_EQ(s.unbalances[0].at.rotor, "hp");
  EXPECT_EQ(s.bodies[0].rotor, "hp");
  EXPECT_EQ(s.bearings[1].from.rotor, "hp");
  EXPECT_EQ(s.bearings[1].to.kind, Station::Kind::position);
  EXPECT_EQ(s.bearings[1].to.rotor, "");
  EXPECT_EQ(s.bearings[1].to.z, 0.1);
  EXPECT_EQ(model.contacts[0].against.rotor, "hp");
  EXPECT_DOUBLE_EQ(model.contacts[0].friction.radius, 0.01);
}

TEST(ModelFile, SaysWhatIsWrongWithFurtherShafts) {
  const auto problem = [](const std::string& more) {
    try {
      parse_model(two_shafts(more), "m.toml");
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const auto expect = [&](const std::string& more, const std::string& words) {
    EXPECT_NE(problem(more).find(words), std::string::npos) << problem(more);
  };
  expect("[[disk]]\nrotor = \"lp\"\nat = 0.3\nmass = 1\n", "expected one of shaft, hp");
  expect("[[disk]]\nrotor = \"hp\"\nat = 0.6\nmass = 1\n", "reaches from 100 to 500 mm");
  expect("[[disk]]\nrotor = \"hp\"\nnode = 2\nmass = 1\n", "goes with at = position");
  expect("[[bearing]]\nat = 0.3\nto = \"shaft\"\nstiffness = 1\n", "expected another one");
  expect("[[bearing]]\nnode = 1\nto = \"hp\"\nstiffness = 1\n", "needs at = position");
  expect("[[body]]\nname = \"b\"\nmass = 1\nrotor = \"hp\"\n", "spins = true");
  const std::string contact =
      "[[contact]]\nat = 0.3\nagainst = \"hp\"\nclearance = 1e-3\nstiffness = 1e6\n";
  EXPECT_EQ(problem(contact), "nothing");
  expect(contact + "slip = \"forward\"\nfriction = 0.1\n", "always has the sense of the spin");
}

TEST(ModelFile, AStationBetweenTheNodesAddsOneBehindTheOthers) {
  const Model model = rotor("[[disk]]\nat = \"125 mm\"\nmass = 1\n[[disk]]\nnode = 13\nmass = 1\n");
  const Assembler assembler(model.structure);
  EXPECT_EQ(assembler.mesh().nodes(), 14);
  EXPECT_EQ(assembler.point(model.structure.disks[0].at).index, 13);
  EXPECT_EQ(assembler.point(model.structure.disks[1].at).index, 12);
  EXPECT_DOUBLE_EQ(assembler.mesh().z[12], 0.6);
}

// ---- set, source ----

TEST(ModelFile, WhatIsSetCountsAsIfItStoodInTheFile) {
  const Model model = rotor("[[bearing]]\nname = \"left\"\nnode = 1\nstiffness = 1\n",
                            {"bearing.left.stiffness=8 MN/m", "operation.speed=4430rpm",
                             "shaft.1.elements=24", "start.whirl=[{mode=1, amplitude=\"2 mm\"}]"});
  const auto& bearing = std::get<ConstantBearing>(model.structure.bearings[0].coefficients);
  EXPECT_EQ(bearing.K, Mat2(8e6 * Mat2::Identity()));
  EXPECT_DOUBLE_EQ(model.speed, 4430.0 * rpm);
  EXPECT_TRUE(model.has_speed);
  EXPECT_EQ(model.structure.shaft[0].elements, 24);
  EXPECT_EQ(model.start.whirl.at(0).amplitude, 2e-3);
}

TEST(ModelFile, TheSourceIsTheTextItselfOrTheTreeWithWhatWasSet) {
  const std::string text = "format = 1  # a stable rotor\n[[body]]\nname = \"m\"\nmass = 1\n";
  EXPECT_EQ(parse_model(text).source, text);
  const std::string set = parse_model(text, "m", {"body.m.mass=2 kg"}).source;
  EXPECT_NE(set, text);
  EXPECT_EQ(parse_model(set).structure.bodies.at(0).m.x, 2.0);
  EXPECT_EQ(parse_model(set).source, set);
}

TEST(ModelFile, BundledModelsSurviveBeingStored) {
  int models = 0;
  for (const auto& entry : fs::directory_iterator(WHIRL_SOURCE_DIR "/models")) {
    if (entry.path().extension() != ".toml") continue;
    ++models;
    SCOPED_TRACE(entry.path().string());
    const Model model = read_model(entry.path(), {"title=stored"});
    const Model again = parse_model(model.source);
    EXPECT_EQ(again.source, model.source);
    const System a = assemble(model.structure, 100.0), b = assemble(again.structure, 100.0);
    EXPECT_EQ(Mat(a.M), Mat(b.M));
    EXPECT_EQ(Mat(a.K), Mat(b.K));
    EXPECT_EQ(Mat(a.C), Mat(b.C));
    EXPECT_EQ(again.contacts.size(), model.contacts.size());
  }
  EXPECT_GT(models, 0);
}

}  // namespace whirl::model_file_test
