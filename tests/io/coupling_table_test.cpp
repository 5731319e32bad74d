// [[coupling]] in model files: a link, two disks, and loads of misalignment.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "libbase/error.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::coupling_table_test {

using test::pi;

const std::string train = R"(format = 1
[material.steel]
density = 7850
youngs_modulus = 2.1e11
poisson_ratio = 0.3
[[rotor]]
name = "generator"
ratio = 1
position = "520 mm"
[[shaft]]
material = "steel"
length = "500 mm"
outer_diameter = "50 mm"
[[shaft]]
rotor = "generator"
material = "steel"
length = "400 mm"
outer_diameter = "60 mm"
[[coupling]]
name = "hub"
from = { at = "500 mm" }
to = { at = "520 mm", rotor = "generator" }
)";

const Force& force_named(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.structure.forces, name, &Force::name);
  EXPECT_NE(found, model.structure.forces.end()) << name;
  return *found;
}

TEST(CouplingTable, IsALinkAndTwoHalves) {
  const Model model = parse_model(train +
                                  "stiffness = \"2 MN/m\"\ndamping = 300\n"
                                  "tilt_stiffness = \"40 kN.m/rad\"\nmass = 3\n"
                                  "diametral_inertia = 0.004\npolar_inertia = 0.007\n");
  ASSERT_EQ(model.structure.links.size(), 1u);
  const BearingCoefficients c = coefficients(model.structure.links[0].coefficients, 0.0);
  EXPECT_EQ(c.K(0, 0), 2e6);
  EXPECT_EQ(c.Kt(1, 1), 4e4);
  ASSERT_EQ(model.structure.disks.size(), 2u);
  EXPECT_EQ(model.structure.disks[0].name, "hub half 1");
  EXPECT_EQ(model.structure.disks[1].at.rotor, "generator");
  EXPECT_EQ(model.structure.disks[1].Ip, 0.007);
  EXPECT_TRUE(model.structure.forces.empty());
}

// K d on one end and the opposite on the other: constant, once and twice a revolution
TEST(CouplingTable, MisalignmentMakesLoads) {
  const Model model =
      parse_model(train +
                  "stiffness = 2e6\ntilt_stiffness = 4e4\nanisotropy = 0.2\n"
                  "misalignment = { offset = \"0.1 mm\", angle = \"30 deg\", tilt = \"1 mrad\" }\n"
                  "runout = { offset = \"20 um\", angle = \"90 deg\" }\n");
  EXPECT_EQ(model.structure.forces.size(), 10u);
  const Force& constant = force_named(model, "hub force 1");
  EXPECT_NEAR(constant.size, 200.0, 1e-10);
  EXPECT_NEAR(constant.angle, pi / 6.0, 1e-14);
  EXPECT_TRUE(constant.is_constant());
  EXPECT_NEAR(force_named(model, "hub moment 1").size, 40.0, 1e-12);
  EXPECT_NEAR(force_named(model, "hub force 2").angle, pi / 6.0 + pi, 1e-14);
  const Force& once = force_named(model, "hub 1X force 1");
  EXPECT_NEAR(once.size, 40.0, 1e-12);
  EXPECT_EQ(once.order, 1.0);
  EXPECT_EQ(once.turning, Turning::forward);
  EXPECT_NEAR(once.phase, 0.5 * pi, 1e-14);
  const Force& twice = force_named(model, "hub 2X force 1");
  EXPECT_NEAR(twice.size, 40.0, 1e-12);
  EXPECT_EQ(twice.order, 2.0);
  EXPECT_NEAR(twice.phase, -pi / 6.0, 1e-14);
  EXPECT_EQ(twice.at.z, 0.5);
}

// A bore that is off by e, of two shafts that nothing else moves, is taken up by the shafts: the
// response to the loads is that of two shafts whose ends are e apart without force.
TEST(CouplingTable, RunoutIsTakenUpByTheShafts) {
  std::string text =
      train +
      "stiffness = 2e12\nrunout = { offset = \"20 um\" }\n"
      "[[bearing]]\nat = 0\nstiffness = 1e7\n[[bearing]]\nat = 0.4\nstiffness = 1e7\n"
      "[[bearing]]\nat = 0.6\nrotor = \"generator\"\nstiffness = 1e7\n"
      "[[bearing]]\nat = 0.92\nrotor = \"generator\"\nstiffness = 1e7\n";
  const Model model = parse_model(text);
  const Assembler assembler(model.structure);
  const UnbalanceResponse response =
      unbalance_response(assembler, {1e-3}, assembler.dofs().points());
  const auto& points = assembler.dofs().points();
  const auto row = [&](double z, const char* rotor) {
    Station at = test::at(z);
    at.rotor = rotor;
    return std::ranges::find(points, assembler.point(at)) - points.begin();
  };
  const Complex apart = response.at(X)(row(0.5, ""), 0) - response.at(X)(row(0.52, "generator"), 0);
  EXPECT_NEAR(apart.real(), 20e-6, 1e-9);
}

TEST(CouplingTable, WrongOnesAreToldWithTheirPlace) {
  const auto told = [](std::string lines, const char* key, const char* words,
                       const char* ratio = "ratio = 1\n") {
    std::string text = train;
    text.replace(text.find("ratio = 1\n"), 10, ratio);
    try {
      parse_model(text + lines);
      ADD_FAILURE() << "it is read: " << lines;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.problems().size(), 1u) << error.what();
      EXPECT_EQ(error.problems().front().key, std::string("coupling.hub.") + key);
      EXPECT_NE(error.problems().front().message.find(words), std::string::npos) << error.what();
    }
  };
  told("", "stiffness", "missing");
  told("rigid = true\nrunout = { offset = 1e-5 }\n", "runout", "no stiffness");
  told("rigid = true\nstiffness = 1\n", "rigid", "leave them out");
  told("stiffness = 1\nanisotropy = 1\n", "anisotropy", "less than 1");
  told("stiffness = 1\n", "to", "expected the same speed", "ratio = 2\n");
}

}  // namespace whirl::coupling_table_test
