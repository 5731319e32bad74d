// Model files: every key arrives where it belongs, in SI.

#include "libio/model_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "libfe/assemble.hpp"

namespace whirl::model_file_test {

namespace fs = std::filesystem;

constexpr double pi = std::numbers::pi;
constexpr double rpm = pi / 30.0;

/// A shaft of 600 mm with 13 nodes, and what a test adds to it.
Model rotor(const std::string& parts = "", const std::vector<std::string>& sets = {}) {
  return parse_model(R"(
format = 1
[material.steel]
density = "7800 kg/m^3"
youngs_modulus = "211 GPa"
shear_modulus = "81.2 GPa"
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
)" + parts,
                     "model.toml", sets);
}

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

const BearingCoefficients& constant(const Connection& c) {
  return std::get<ConstantBearing>(c.coefficients).value;
}

Mat2 isotropic(double k) {
  return k * Mat2::Identity();
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
  EXPECT_EQ(bodies[0].m, 50.0);
  EXPECT_FALSE(bodies[0].spins);
  EXPECT_FALSE(bodies[0].tilts);
  EXPECT_EQ(bodies[1].m, 2000.0);
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

// ---- bearings and links ----

TEST(ModelFile, BearingIsotropic) {
  const Connection b = rotor(R"(
[[bearing]]
name = "left"
at = "0 mm"
stiffness = "4 MN/m"
damping = "5e3 N.s/m"
tilt_stiffness = "2 kN.m/rad"
tilt_damping = "3 N.m.s/rad"
)")
                           .structure.bearings.at(0);
  EXPECT_EQ(b.name, "left");
  EXPECT_EQ(b.from.kind, Station::Kind::position);
  EXPECT_EQ(b.to.kind, Station::Kind::ground);
  EXPECT_FALSE(b.is_rigid);
  EXPECT_FALSE(b.is_clamped);
  EXPECT_EQ(constant(b).K, isotropic(4e6));
  EXPECT_EQ(constant(b).C, isotropic(5e3));
  EXPECT_EQ(constant(b).Kt, isotropic(2e3));
  EXPECT_EQ(constant(b).Ct, isotropic(3.0));
}

TEST(ModelFile, BearingWithMatrices) {
  const Connection b = rotor(R"(
[[bearing]]
node = 1
stiffness = { xx = "1 N/um", yy = 2e6, xy = "3 kN/m", yx = -4e3 }
damping = { xx = 5, yy = 6 }
tilt_stiffness = { xx = 7, yy = 8, xy = 9 }
tilt_damping = { xx = 1, yy = 2, yx = 3 }
)")
                           .structure.bearings.at(0);
  EXPECT_EQ(b.name, "bearing 1");
  EXPECT_TRUE(constant(b).K.isApprox((Mat2() << 1e6, 3e3, -4e3, 2e6).finished(), 1e-15));
  EXPECT_EQ(constant(b).C, (Mat2() << 5, 0, 0, 6).finished());
  EXPECT_EQ(constant(b).Kt, (Mat2() << 7, 9, 0, 8).finished());
  EXPECT_EQ(constant(b).Ct, (Mat2() << 1, 0, 3, 2).finished());
}

TEST(ModelFile, BearingRigidAndClamped) {
  const auto& b = rotor(R"(
[[bearing]]
node = 1
rigid = true
[[bearing]]
node = 13
clamped = true
)")
                      .structure.bearings;
  EXPECT_TRUE(b[0].is_rigid);
  EXPECT_FALSE(b[0].is_clamped);
  EXPECT_TRUE(b[1].is_rigid);
  EXPECT_TRUE(b[1].is_clamped);
}

TEST(ModelFile, BearingToABody) {
  const Connection b = rotor(R"(
[[body]]
name = "pedestal"
mass = 10
[[bearing]]
node = 1
to = "pedestal"
stiffness = 1
)")
                           .structure.bearings.at(0);
  EXPECT_EQ(b.to.kind, Station::Kind::body);
  EXPECT_EQ(b.to.body, "pedestal");
}

TEST(ModelFile, BearingFromATableBesideTheModel) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_model_test_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "bearing.csv") << "speed [rpm],kxx,kyy\n0,1e6,2e6\n1000,3e6,4e6\n";
  std::ofstream(folder / "model.toml") << R"(format = 1   # first
[material.steel]
density = 7800
youngs_modulus = 211e9
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = 0.05
[[bearing]]
node = 1
table = "bearing.csv"
)";
  const Model model = read_model(folder / "model.toml");
  fs::remove_all(folder);
  const auto& t = std::get<TableBearing>(model.structure.bearings.at(0).coefficients);
  EXPECT_DOUBLE_EQ(t.speed.at(1), 1000.0 * rpm);
  EXPECT_EQ(t.rows.at(1).K, (Mat2() << 3e6, 0, 0, 4e6).finished());
  // the model that goes into a result holds the table itself: the file is gone by now
  const Model again = parse_model(model.source);
  EXPECT_EQ(std::get<TableBearing>(again.structure.bearings.at(0).coefficients).speed, t.speed);
}

TEST(ModelFile, LinksInEveryFormOfStation) {
  const auto& links = rotor(R"(
[[body]]
name = "stator"
mass = 10
[[body]]
name = "pedestal"
mass = 10
[[link]]
name = "strut"
from = "stator"
to = "pedestal"
stiffness = "1 MN/m"
[[link]]
from = { at = "100 mm" }
to = { node = 4 }
damping = 5
tilt_stiffness = 6
tilt_damping = 7
[[link]]
from = { body = "pedestal" }
to = "ground"
rigid = true
)")
                          .structure.links;
  ASSERT_EQ(links.size(), 3u);
  EXPECT_EQ(links[0].name, "strut");
  EXPECT_EQ(links[0].from.body, "stator");
  EXPECT_EQ(links[0].to.body, "pedestal");
  EXPECT_EQ(constant(links[0]).K, isotropic(1e6));
  EXPECT_EQ(links[1].name, "link 2");
  EXPECT_EQ(links[1].from.z, 0.1);
  EXPECT_EQ(links[1].to.node, 4);
  EXPECT_EQ(constant(links[1]).C, isotropic(5.0));
  EXPECT_EQ(constant(links[1]).Kt, isotropic(6.0));
  EXPECT_EQ(constant(links[1]).Ct, isotropic(7.0));
  EXPECT_EQ(links[2].from.body, "pedestal");
  EXPECT_EQ(links[2].to.kind, Station::Kind::ground);
  EXPECT_TRUE(links[2].is_rigid);
}

// ---- contacts ----

TEST(ModelFile, ContactWithEveryKey) {
  const Model model = rotor(R"(
[[body]]
name = "stator"
mass = 10
[[bearing]]
body = "stator"
stiffness = 1
[[contact]]
name = "seal"
law = "radial"
at = "300 mm"
against = "stator"
clearance = "5 mm"
stiffness = "4 MN/m"
damping = "20 N.s/m"
friction = 0.1
slip = "forward"
radius = "12 mm"
slip_tolerance = "1 mm/s"
offset = ["1 mm", "-2 mm"]
)");
  const Contact& c = model.contacts.at(0);
  EXPECT_EQ(c.name, "seal");
  EXPECT_EQ(c.at.z, 0.3);
  EXPECT_EQ(c.against.body, "stator");
  EXPECT_EQ(c.clearance, 5e-3);
  EXPECT_EQ(c.offset, Vec2(1e-3, -2e-3));
  EXPECT_EQ(c.friction.mu, 0.1);
  EXPECT_EQ(c.friction.slip, Slip::forward);
  EXPECT_EQ(c.friction.radius, 12e-3);
  EXPECT_EQ(c.friction.tolerance, 1e-3);
  const auto& law = std::get<Radial<>>(c.law);
  EXPECT_EQ(law.k, 4e6);
  EXPECT_EQ(law.c, 20.0);
}

TEST(ModelFile, ContactDefaults) {
  const Contact c =
      rotor("[[contact]]\nnode = 7\nclearance = 1e-3\nstiffness = 1e6\n").contacts.at(0);
  EXPECT_EQ(c.name, "contact 1");
  EXPECT_EQ(c.against.kind, Station::Kind::ground);
  EXPECT_EQ(c.offset, Vec2::Zero());
  EXPECT_EQ(c.friction.mu, 0.0);
  EXPECT_EQ(c.friction.slip, Slip::actual);
  EXPECT_EQ(c.friction.tolerance, 0.0);
  EXPECT_EQ(std::get<Radial<>>(c.law).c, 0.0);
}

TEST(ModelFile, HertzContact) {
  const Contact c = rotor(
                        "[[contact]]\nnode = 7\nclearance = \"0.1 mm\"\nlaw = \"hertz\"\n"
                        "hertz_stiffness = \"23.33 kN/mm^1.5\"\n")
                        .contacts.at(0);
  EXPECT_NEAR(std::get<Hertz<>>(c.law).k, 23.33e3 * std::pow(1e3, 1.5), 1e-3);
}

TEST(ModelFile, ContactRadiusIsThatOfTheShaftThere) {
  const std::string cone = R"(
[[shaft]]
material = "steel"
length = "400 mm"
outer_diameter = ["40 mm", "80 mm"]
[[contact]]
clearance = 1e-3
stiffness = 1e6
friction = 0.1
)";
  const auto radius = [&](const std::string& at) {
    return rotor(cone + "at = \"" + at + "\"\n").contacts.at(0).friction.radius;
  };
  EXPECT_DOUBLE_EQ(radius("300 mm"), 0.010);
  EXPECT_DOUBLE_EQ(radius("600 mm"), 0.020);  // at a step the larger one
  EXPECT_NEAR(radius("800 mm"), 0.030, 1e-15);
  EXPECT_DOUBLE_EQ(radius("1 m"), 0.040);
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
  EXPECT_EQ(constant(model.structure.bearings[0]).K, isotropic(8e6));
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
  EXPECT_EQ(parse_model(set).structure.bodies.at(0).m, 2.0);
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
