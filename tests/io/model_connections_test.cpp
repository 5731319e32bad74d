// Model files: bearings, links and contacts arrive where they belong, in SI.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>

#include "libfe/assembly/assemble.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::model_connections_test {

namespace fs = std::filesystem;
using test::rotor;

constexpr double rpm = std::numbers::pi / 30.0;

const ConstantBearing& constant(const Connection& c) {
  return std::get<ConstantBearing>(c.coefficients);
}

Mat2 isotropic(double k) {
  return k * Mat2::Identity();
}

// What no one can move is no model, with the place of the file.
TEST(ModelConnections, SomethingMustBeFreeToMove) {
  const auto problem = [](const std::string& text) -> std::string {
    try {
      parse_model("format = 1\n" + text, "model.toml");
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string held =
      "[[body]]\nname = \"rotor\"\nmass = 1\n[[bearing]]\nbody = \"rotor\"\nrigid = true\n";
  EXPECT_TRUE(problem(held).starts_with("model.toml:1:1: nothing can move")) << problem(held);
  // a mass that is held, and a free body without one
  const std::string light =
      held + "[[body]]\nname = \"light\"\nmass = 0\n[[bearing]]\nbody = \"light\"\nstiffness = 1\n";
  EXPECT_NE(problem(light).find("nothing that can move"), std::string::npos) << problem(light);
}

// ---- bearings and links ----

TEST(ModelConnections, BearingIsotropic) {
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

TEST(ModelConnections, BearingWithMatrices) {
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

TEST(ModelConnections, BearingRigidAndClamped) {
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

TEST(ModelConnections, BearingToABody) {
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

TEST(ModelConnections, BearingFromATableBesideTheModel) {
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
  const auto& t = std::get<TableBearing>(model.structure.bearings.at(0).coefficients).table;
  EXPECT_DOUBLE_EQ(t.speed.at(1), 1000.0 * rpm);
  EXPECT_EQ(t.rows.at(1).K, (Mat2() << 3e6, 0, 0, 4e6).finished());
  // the model that goes into a result holds the table itself: the file is gone by now
  const Model again = parse_model(model.source);
  EXPECT_EQ(std::get<TableBearing>(again.structure.bearings.at(0).coefficients).table.speed,
            t.speed);
}

// The word says what the keys say without it; and a model of every kind is read.
TEST(ModelConnections, BearingsByTheirKind) {
  const auto kinds = [](const std::string& text) {
    const Connection b = rotor("[[bearing]]\nnode = 1\n" + text).structure.bearings.at(0);
    return std::visit([](const auto& kind) { return kind.name; }, b.coefficients);
  };
  const std::string table = R"(table = """
speed,kxx
1,5
""")";
  EXPECT_EQ(kinds("damping = 1"), "constant");
  EXPECT_EQ(kinds("kind = \"constant\"\ndamping = 1"), "constant");
  EXPECT_EQ(kinds(table), "table");
  EXPECT_EQ(kinds("kind = \"table\"\n" + table), "table");
}

TEST(ModelConnections, AddedMassAndInterpolation) {
  const auto& b = rotor(R"(
[[bearing]]
node = 1
stiffness = 5
added_mass = "2 kg"
[[bearing]]
node = 13
interpolation = "pchip"
table = """
whirl [rpm], speed [rpm], kxx [N/m], mxx
0, 1000, 5, 1
500, 1000, 7, 2
"""
)")
                      .structure.bearings;
  EXPECT_EQ(constant(b[0]).M, isotropic(2.0));
  const auto& t = std::get<TableBearing>(b[1].coefficients);
  EXPECT_EQ(t.interpolation, Interpolation::pchip);
  EXPECT_DOUBLE_EQ(t.table.whirl.at(1), 500.0 * rpm);
  EXPECT_EQ(t.table.rows.at(1).M(0, 0), 2.0);
}

// A seal is a bearing that stands elsewhere: same keys, same kinds, tables kept in results.
TEST(ModelConnections, SealsAreTheSameFamily) {
  const Model model = rotor(R"(
[[seal]]
node = 1
stiffness = { xx = 1e5, yy = 1e5, xy = 2e4, yx = -2e4 }
[[seal]]
name = "balance piston"
at = "100 mm"
added_mass = 3
[[seal]]
node = 13
table = """
speed, kxx
1, 5
"""
)");
  const auto& seals = model.structure.seals;
  ASSERT_EQ(seals.size(), 3u);
  EXPECT_TRUE(model.structure.bearings.empty() ||
              seals[0].name != model.structure.bearings[0].name);
  EXPECT_EQ(seals[0].name, "seal 1");
  EXPECT_EQ(constant(seals[0]).K(0, 1), 2e4);
  EXPECT_EQ(constant(seals[1]).M, isotropic(3.0));
  EXPECT_EQ(parse_model(model.source).structure.seals.size(), 3u);
  const Model set = parse_model(model.source, "model", {"seal.balance piston.added_mass=4"});
  EXPECT_EQ(constant(set.structure.seals[1]).M, isotropic(4.0));
}

// A kind that is none hides nothing else.
TEST(ModelConnections, OtherMistakesOfAWrongKindAreTold) {
  const auto told = [](const std::string& keys) -> std::string {
    try {
      rotor("[[seal]]\nat = 0\nkind = \"tabel\"\n" + keys);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "nothing";
  };
  const std::string constant = told("stiffness = \"4 N\"\n");
  EXPECT_NE(constant.find("seal.1.kind: found \"tabel\""), std::string::npos) << constant;
  EXPECT_NE(constant.find("seal.1.stiffness: found \"4 N\""), std::string::npos) << constant;
  const std::string table = told("table = \"speed,kxx\\n1,x\"\n");
  EXPECT_NE(table.find("seal.1.kind: found \"tabel\""), std::string::npos) << table;
  EXPECT_NE(table.find("kxx: \"x\" is not a number"), std::string::npos) << table;
  const std::string alone = told("");
  EXPECT_EQ(std::count(alone.begin(), alone.end(), '\n'), 0) << alone;  // that one is enough
}

// Mistakes of a table that stands in the model have the model's file and the line of the key.
TEST(ModelConnections, MistakesInATableInTheModelAreInItsFile) {
  try {
    rotor("[[seal]]\nat = \"100 mm\"\ntable = \"\"\"\nspeed, kxx, kyy\n1, x, 5\n\"\"\"\n");
    FAIL() << "the table is wrong";
  } catch (const ModelError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(std::regex_search(
        text, std::regex("model.toml:14: seal\\.1\\.table:2:4: kxx: \"x\" is not a number")))
        << text;
  }
}

// Bearings and seals tell a clearance, which is no coefficient; links have none.
TEST(ModelConnections, ClearancesOfBearingsAndSeals) {
  const std::string text = R"(
[[bearing]]
name = "left"
at = "0 mm"
stiffness = "4 MN/m"
clearance = "0.11 mm"
[[seal]]
at = "100 mm"
stiffness = 5
)";
  const Model model = rotor(text);
  EXPECT_DOUBLE_EQ(model.structure.bearings.at(0).clearance, 0.11e-3);
  EXPECT_EQ(model.structure.seals.at(0).clearance, 0.0);
  const Model set = parse_model(model.source, "model", {"seal.1.clearance=0.2 mm"});
  EXPECT_DOUBLE_EQ(set.structure.seals.at(0).clearance, 0.2e-3);
  EXPECT_THROW(parse_model(model.source, "model", {"bearing.left.clearance=0 mm"}), ModelError);
  EXPECT_THROW(rotor("[[bearing]]\nat = 0\nclearance = 1e-4\n"), ModelError);  // and no stiffness
  EXPECT_THROW(rotor("[[link]]\nfrom = { at = 0 }\nto = \"ground\"\nstiffness = 1\n"
                     "clearance = 1e-4\n"),
               ModelError);
}

TEST(ModelConnections, LinksInEveryFormOfStation) {
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

TEST(ModelConnections, ContactWithEveryKey) {
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

TEST(ModelConnections, ContactDefaults) {
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

TEST(ModelConnections, HertzContact) {
  const Contact c = rotor(
                        "[[contact]]\nnode = 7\nclearance = \"0.1 mm\"\nlaw = \"hertz\"\n"
                        "hertz_stiffness = \"23.33 kN/mm^1.5\"\n")
                        .contacts.at(0);
  EXPECT_NEAR(std::get<Hertz<>>(c.law).k, 23.33e3 * std::pow(1e3, 1.5), 1e-3);
  EXPECT_EQ(std::get<Hertz<>>(c.law).alpha, 0.0);
}

TEST(ModelConnections, DampedHertzContact) {
  const Contact c = rotor(
                        "[[contact]]\nnode = 7\nclearance = 1e-4\nlaw = \"hertz\"\n"
                        "hertz_stiffness = 1e9\ndissipation = \"2 ms/mm\"\n")
                        .contacts.at(0);
  EXPECT_NEAR(std::get<Hertz<>>(c.law).alpha, 2.0, 1e-15);
}

TEST(ModelConnections, ContactRadiusIsThatOfTheShaftThere) {
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

}  // namespace whirl::model_connections_test
