// Machines that ROSS saved: two shafts, gears, couplings, magnetic, ball and roller bearings.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfe/analyses/modes.hpp"
#include "libfe/mesh/elements/gear.hpp"
#include "tests/io/ross_files.hpp"

namespace whirl::ross_machines_test {

using std::numbers::pi;
using test::has_part;
using test::imported;
using test::model_in_files;
using test::refusal;

constexpr Complex i{0.0, 1.0};

/// Elements in a row, each 50 mm long unless told, as ROSS saves them.
std::string elements(int first, int count, double outer, double inner, double length = 0.05) {
  std::string text;
  for (int n = first; n < first + count; ++n) {
    text += fmt::format(
        "[\"ShaftElement_Shaft Element {0}\"]\nL = {4}\nidl = {2}\nodl = {1}\nidr = {2}\nodr = "
        "{1}\nn = {0}\naxial_force = 0\ntorque = 0\nshear_effects = true\nrotary_inertia = true\n"
        "gyroscopic = true\nshear_method_calc = \"cowper\"\ntag = \"Shaft Element {0}\"\nalpha = "
        "0.0\nbeta = 0.0\n[\"ShaftElement_Shaft Element {0}\".material]\nname = \"Steel\"\nrho = "
        "7800.0\nE = 210000000000.0\nG_s = {3}\ncolor = \"#525252\"\n",
        n, outer, inner, 2.1e11 / 2.6, length);
  }
  return text;
}

std::string disk(int node, double m, double Id, double Ip) {
  return fmt::format("[\"DiskElement_Disk {0}\"]\nn = {0}\nm = {1}\nId = {2}\nIp = {3}\n", node, m,
                     Id, Ip);
}

std::string bearing(int node, double k, double c, const std::string& more = "") {
  return fmt::format(
      "[\"BearingElement_Bearing {0}\"]\nn = {0}\nkxx = [ {1},]\nkyy = [ {1},]\ncxx = [ {2},]\n"
      "cyy = [ {2},]\n{3}",
      node, k, c, more);
}

/// A solid inner shaft of 1 m and a hollow one around it from 0.3 to 0.8 m, with a bearing between
/// them at 0.8 m.
std::string coaxial(const std::string& parameters) {
  return "ross_version = \"3.0.0\"\n[parameters]\n" + parameters + elements(0, 20, 0.04, 0.0) +
         elements(21, 10, 0.08, 0.06) + disk(2, 6.0, 0.02, 0.04) + disk(18, 8.0, 0.03, 0.06) +
         disk(23, 5.0, 0.015, 0.03) + disk(29, 4.0, 0.01, 0.02) + bearing(0, 2e7, 100.0) +
         bearing(20, 1.5e7, 100.0) + bearing(21, 3e7, 100.0) +
         bearing(16, 2e7, 0.0, "n_link = 31\n");
}

std::vector<double> frequencies(const Model& model, double Omega, int count) {
  std::vector<double> all;
  for (const Mode& mode : complex_modes(Assembler(model.structure), Omega, count).oscillatory) {
    all.push_back(mode.frequency() / (2.0 * pi));
  }
  return all;
}

// An independent program, of elements of the same kind assembled with numpy, found the numbers
// [Hz].
TEST(RossMachines, CoaxialShaftsHaveTheFrequenciesOfAnotherProgram) {
  const std::vector<double> along{53.164145,  61.059634,  148.227680, 153.363304, 286.259985,
                                  287.266400, 295.685804, 307.018827, 403.882903, 429.080345};
  const std::vector<double> against{54.409762,  59.639794,  148.975969, 152.674981, 286.349590,
                                    287.150054, 295.727320, 307.007357, 411.023240, 418.065996};
  for (const auto& [ratio, expected] : {std::pair(1.5, along), {-1.5, against}}) {
    const ImportedModel written = imported(coaxial(fmt::format("speed_ratio = {}\n", ratio)));
    EXPECT_FALSE(has_part(written.taken_differently, "turns as the first one"));
    const Model model = model_in_files(written);
    ASSERT_EQ(model.structure.rotors.size(), 1u);
    EXPECT_EQ(model.structure.rotors[0].name, "outer");
    EXPECT_NEAR(model.structure.rotors[0].z, 0.3, 1e-15);
    const auto found = frequencies(model, 500.0, 10);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k], expected[k], 6e-7) << ratio << ", " << k;
    }
  }
}

// Files of ROSS 3.0 and before lack the ratio: it is 1, as ROSS takes it then.
TEST(RossMachines, SaysThatTheFileHasNoSpeedOfTheOuterShaft) {
  const ImportedModel written = imported(coaxial(""));
  EXPECT_TRUE(has_part(written.taken_differently, "\"outer\" turns as the first one"));
  EXPECT_EQ(model_in_files(written).structure.rotors.at(0).ratio, 1.0);
}

// A table on the outer shaft goes with the speed of that one, which ROSS does not turn it with.
TEST(RossMachines, SaysWhichSpeedTablesOfTheOuterShaftGoWith) {
  std::string text = coaxial("speed_ratio = 2.0\n");
  const std::string constant = fmt::format("kxx = [ {0},]\nkyy = [ {0},]\n", 3e7);
  text.replace(text.find(constant), constant.size(), "kxx = [1e7, 3e7]\nspeed = [0.0, 900.0]\n");
  const ImportedModel written = imported(text);
  EXPECT_TRUE(has_part(written.taken_differently, "the table of \"Bearing 21\" goes with"));
  EXPECT_FALSE(has_part(imported(coaxial("speed_ratio = 2.0\n")).taken_differently, "goes with"));
}

// A disk needs a shaft.
TEST(RossMachines, RefusesDisksBesideTheShafts) {
  EXPECT_NE(refusal(coaxial("") + disk(40, 1.0, 0.0, 0.0)).find("there is no shaft at node 40"),
            std::string::npos);
}

// Supports have nodes between those of both shafts in a file, and none in a model; one of them is
// called as the shaft would be.
TEST(RossMachines, CountsNodesOfShaftsWithoutThoseOfSupports) {
  const std::string text = "ross_version = \"3.0.0\"\n" + elements(0, 4, 0.05, 0.0) +
                           elements(6, 2, 0.09, 0.06) + bearing(0, 1e7, 10.0, "n_link = 5\n") +
                           bearing(5, 1e8, 0.0) + bearing(4, 1e7, 10.0) +
                           bearing(6, 2e7, 0.0, "n_link = 1\n") + bearing(8, 3e7, 0.0) +
                           disk(7, 2.0, 0.01, 0.02) + "[PointMass_outer]\nn = 5\nm = 3.0\n";
  const Structure s = model_in_files(imported(text)).structure;
  EXPECT_EQ(s.disks.at(0).at.node, 7);
  EXPECT_EQ(s.links.at(0).from.node, 6);
  EXPECT_EQ(s.links.at(0).to.node, 2);
  EXPECT_NEAR(s.rotors.at(0).z, 0.05, 1e-15);
  EXPECT_EQ(s.bodies.at(0).name, "outer 2");
  EXPECT_NO_THROW(Assembler{s});
  EXPECT_NE(
      refusal("ross_version = \"3.0.0\"\n" + elements(0, 4, 0.05, 0.0) + elements(6, 2, 0.09, 0.06))
          .find("neither an element nor a support at node 5"),
      std::string::npos);
}

std::string gear(const std::string& tag, int node, double m, int teeth, double base_radius,
                 const std::string& more) {
  return fmt::format(
      "[GearElement_{0}]\nn = {1}\nm = {2}\nId = 0.02\nIp = 0.04\nn_teeth = {3}\npitch_diameter = "
      "{4}\npr_angle = {5}\nhelix_angle = 0\ntag = \"{0}\"\n{6}",
      tag, node, m, teeth, 2.0 * base_radius / std::cos(pi / 8.0), pi / 8.0, more);
}

/// The turbo-alternator of Rao, Shiau and Chang (1998), which is ROSS's example of two shafts.
std::string turbo_alternator(const std::string& parameters, const std::string& of_gears = "") {
  return "ross_version = \"3.0.0\"\n[parameters]\n" + parameters + elements(0, 1, 0.3, 0.0, 0.1) +
         elements(1, 1, 0.3, 0.0, 4.24) + elements(2, 1, 0.22, 0.0, 1.16) +
         elements(3, 1, 0.22, 0.0, 0.3) + elements(5, 1, 0.15, 0.0, 0.3) +
         elements(6, 1, 0.15, 0.0, 5.0) + elements(7, 1, 0.15, 0.0, 0.1) +
         gear("wheel", 4, 726.4, 328, 0.5086, of_gears) +
         gear("pinion", 5, 5.0, 23, 0.03567, of_gears) + bearing(0, 1.9e8, 3e3) +
         bearing(3, 1.9e8, 3e3) + bearing(6, 2e7, 3e3) + bearing(8, 2e7, 3e3);
}

// ROSS's own numbers for the matrix of these teeth, without the stiffness: .14644661, .35355339,
// .85355339.
TEST(RossMachines, TeethAreThoseOfRoss) {
  const ImportedModel written = imported(turbo_alternator(
      "coupled_nodes = [4, 0]\ngear_mesh_stiffness = 1e8\norientation_angle = 0.0\n"));
  const Model model = model_in_files(written);
  ASSERT_EQ(model.structure.gears.size(), 1u);
  const auto e = matrices(model.structure.gears[0], 1.0);
  EXPECT_NEAR(e.K(0, 0), 0.14644661e8, 0.5);
  EXPECT_NEAR(e.K(0, 1), 0.35355339e8, 0.5);
  EXPECT_NEAR(e.K(1, 1), 0.85355339e8, 0.5);
  EXPECT_NEAR(e.K(4, 1), -0.35355339e8, 0.5);
  const Rotor& driven = model.structure.rotors.at(0);
  EXPECT_EQ(driven.name, "driven");
  EXPECT_DOUBLE_EQ(driven.ratio, -328.0 / 23.0);
  EXPECT_NEAR(driven.z, 5.8, 1e-12);  // both gears are in one plane
  EXPECT_NO_THROW(Assembler{model.structure});
  EXPECT_TRUE(has_part(written.taken_differently, "no torsion"));
  EXPECT_FALSE(has_part(written.taken_differently, "orientation_angle"));
  EXPECT_FALSE(has_part(written.taken_differently, "is a disk"));
}

// Without a stiffness in the file it follows from the widths, 1.9188719759e9 N/m in ROSS's own test
// with steel of 207 GPa and 7800 kg/m^3; without these teeth are left out, but not the ratio.
TEST(RossMachines, StiffnessOfTeethFollowsFromTheirWidth) {
  const double d = 2.0 * 0.5086 / std::cos(pi / 8.0);
  const std::string width =
      fmt::format("width = {}\n", 4.0 * 726.4 / (7800.0 * pi * (d * d - 0.22 * 0.22)));
  const std::string material = "material.rho = 7800.0\nmaterial.E = 2.07e11\n";
  const ImportedModel by_width = imported(turbo_alternator("", width + material));
  EXPECT_NEAR(model_in_files(by_width).structure.gears.at(0).stiffness, 1.9188719759364796e9, 1e-3);
  EXPECT_TRUE(has_part(by_width.taken_differently, "no orientation_angle"));
  const ImportedModel by_bore = imported(turbo_alternator("", "bore_diameter = 0.22\n" + material));
  EXPECT_NEAR(model_in_files(by_bore).structure.gears.at(0).stiffness, 1.9188719759364796e9, 1e-3);
  const ImportedModel without = imported(turbo_alternator(""));
  EXPECT_TRUE(has_part(without.left_out, "the teeth of \"wheel\" and \"pinion\""));
  const Model model = model_in_files(without);
  EXPECT_TRUE(model.structure.gears.empty());
  EXPECT_DOUBLE_EQ(model.structure.rotors.at(0).ratio, -328.0 / 23.0);
}

// A gear of which its width is told instead of its mass is a hollow cylinder.
TEST(RossMachines, WidthOfAGearMakesItsMass) {
  const Model model = model_in_files(imported(
      "ross_version = \"3.0.0\"\n" + elements(0, 2, 0.05, 0.0) +
      "[GearElementTVMS_g]\nn = 1\nwidth = 0.02\nbore_diameter = 0.04\nmodule = 0.002\nn_teeth = "
      "60\nmaterial.rho = 7800.0\nmaterial.E = 2e11\n"));
  const Disk& g = model.structure.disks.at(0);
  const double m = 7800.0 * 0.02 * pi / 4.0 * (0.12 * 0.12 - 0.04 * 0.04);
  EXPECT_NEAR(g.m, m, 1e-14);
  EXPECT_NEAR(g.Ip, m * (0.12 * 0.12 + 0.04 * 0.04) / 8.0, 1e-15);
  EXPECT_NEAR(g.Id, 0.5 * g.Ip + m * 0.02 * 0.02 / 12.0, 1e-15);
}

TEST(RossMachines, EqualHalvesAreThoseOfACoupling) {
  const auto coupled = [](double m_r) {
    return model_in_files(imported(
        "ross_version = \"3.0.0\"\n" + elements(0, 1, 0.05, 0.0) + elements(2, 1, 0.05, 0.0) +
        fmt::format("[CouplingElement_c]\nn = 1\nL = 0.1\nm_l = 2.0\nm_r = {}\nId_l = "
                    "0.01\nId_r = 0.01\nIp_l = 0.02\nIp_r = 0.02\nkt_x = 1e6\nkt_y = "
                    "2e6\nkr_x = 3e4\nkr_y = 4e4\n",
                    m_r)));
  };
  const Structure equal = coupled(2.0).structure, unequal = coupled(3.0).structure;
  ASSERT_EQ(equal.disks.size(), 2u);
  EXPECT_EQ(equal.disks[1].name, "c half 2");
  EXPECT_EQ(unequal.disks[1].name, "c right");
  EXPECT_EQ(unequal.disks[1].m, 3.0);
  for (const Structure& s : {equal, unequal}) {
    const BearingCoefficients c = coefficients(s.links.at(0).coefficients, 0.0);
    EXPECT_EQ(c.K(0, 0), 1e6);
    EXPECT_EQ(c.K(1, 1), 2e6);
    EXPECT_EQ(c.Kt(0, 0), 3e4);
    EXPECT_EQ(c.Kt(1, 1), 4e4);
  }
  EXPECT_EQ(equal.disks[0].Ip, unequal.disks[0].Ip);
  EXPECT_EQ(equal.disks[0].at.node, unequal.disks[0].at.node);
}

/// Magnets of ki and ks, by gaps of 1 mm and poles of 1 cm^2 with 200 windings, and their gains.
struct Magnets {
  double i0 = 1.0, alpha = 0.392, P = 1.0, I = 0.0, D = 1.0, n_f = 1e4, ag = 1e-4;

  double ki() const { return 4e-7 * pi * 200.0 * 200.0 * ag * i0 * std::cos(alpha) / 1e-6; }
  double ks() const { return ki() * i0 / 1e-3; }
  Complex stiffness(double w) const {
    return ki() * (P + I / (i * w) + i * w * D / (1.0 + i * w / n_f)) - ks();
  }
  std::string keys() const {
    return fmt::format(
        "n = 1\ng0 = 0.001\ni0 = {}\nag = {}\nnw = 200\nalpha = {}\nk_amp = 1.0\nk_sense = "
        "1.0\nkp_pid = {}\nki_pid = {}\nkd_pid = {}\n",
        i0, ag, alpha, P, I, D);
  }
  /// With a controller over frequencies, as ROSS 2.2 and later save it.
  std::string over_frequency() const {
    std::vector<double> w{1.0, 30.0, 400.0, 9000.0}, k, c;
    for (const double each : w) {
      k.push_back(stiffness(each).real());
      c.push_back(stiffness(each).imag() / each);
    }
    return fmt::format(
        "[BearingElement_AMB]\n{0}n_f = {1}\nsensors_axis_rotation = 0.78539816\nfrequency = {2}\n"
        "kxx = {3}\nkyy = {3}\ncxx = {4}\ncyy = {4}\n",
        keys(), n_f, w, k, c);
  }
};

std::string on_a_shaft(const std::string& bearings, const std::string& version = "2.3.0") {
  return fmt::format("ross_version = \"{}\"\n", version) + elements(0, 2, 0.05, 0.0) +
         bearing(0, 1e6, 0.0) + bearings;
}

// The stiffness in ROSS's own example is -4640.623377181318 N/m.
TEST(RossMachines, MagneticBearingsOfConstantCoefficientsHaveTheStiffnessOfRoss) {
  const Magnets magnets;
  const std::string coefficients = fmt::format(
      "kxx = [-4640.623377181318]\nkyy = [-4640.623377181318]\ncxx = [{0}]\ncyy = [{0}]\n",
      magnets.ki());
  const ImportedModel written =
      imported(on_a_shaft("[MagneticBearingElement_AMB]\n" + magnets.keys() + coefficients));
  EXPECT_FALSE(has_part(written.taken_differently, "its coefficients alone"));
  const Support support = model_in_files(written).structure.supports.at(0);
  const CMat f = support.law.stiffness_at(200.0 * i);
  const Complex found = f(0, 0) + f(0, 2);
  EXPECT_NEAR(found.real(), -4640.623377181318, 1e-9);
  EXPECT_NEAR(found.imag() / 200.0, magnets.ki(), 1e-12);
}

// K = ki P - ks and C = ki D: 1 MN/m and 4 kN.s/m of 200 N/A and 1 MN/m.
TEST(RossMachines, MagneticBearingsOfTwoGainsAreSpringsAndDampers) {
  const Magnets magnets{.i0 = 5.0, .alpha = 0.0, .P = 1e4, .D = 20.0, .ag = 2.5e-3 / pi};
  EXPECT_NEAR(magnets.ki(), 200.0, 1e-12);
  EXPECT_NEAR(magnets.ks(), 1e6, 1e-9);
  const ImportedModel written =
      imported(on_a_shaft("[MagneticBearingElement_AMB]\n" + magnets.keys() +
                          "kxx = 1e6\nkyy = 1e6\ncxx = 4e3\ncyy = 4e3\n"));
  const CMat f =
      model_in_files(written).structure.supports.at(0).law.stiffness_at(-20.0 + 300.0 * i);
  const Complex found = f(0, 0) + f(0, 2), expected = 1e6 + 4e3 * (-20.0 + 300.0 * i);
  EXPECT_LT(std::abs(found - expected), 1e-12 * std::abs(expected));
}

TEST(RossMachines, MagneticBearingsHaveTheirControllers) {
  const Magnets magnets{.i0 = 2.0, .P = 3e4, .I = 5e5, .D = 40.0, .n_f = 3000.0};
  const ImportedModel written = imported(on_a_shaft(magnets.over_frequency()));
  EXPECT_TRUE(written.tables.empty());
  EXPECT_TRUE(has_part(written.taken_differently, "states of their own"));
  const Support support = model_in_files(written).structure.supports.at(0);
  EXPECT_NEAR(std::atan2(support.acts_on[0].y, support.acts_on[0].x), 0.78539816, 1e-15);
  for (const double w : {1.0, 77.0, 400.0, 2e4}) {  // at the rows of the file and elsewhere
    const CMat f = support.law.stiffness_at(i * w);
    const Complex found = f(1, 1) + f(1, 3), expected = magnets.stiffness(w);
    EXPECT_LT(std::abs(found - expected), 1e-11 * std::abs(expected)) << w;
  }
}

// Where the file does not have the controller, coefficients are all there is; they are those at the
// frequency of the whirl, whatever the version.
TEST(RossMachines, MagneticBearingsWithoutTheirControllerAreTables) {
  const Magnets magnets{.P = 3e4, .D = 40.0};
  const auto taken = [&](const std::string& from, const std::string& to) {
    std::string text = on_a_shaft(magnets.over_frequency());
    text.replace(text.find(from), from.size(), to);
    const ImportedModel written = imported(text);
    EXPECT_EQ(written.tables.at(0).text.substr(0, 13), "whirl [rad/s]");
    EXPECT_TRUE(model_in_files(written).structure.supports.empty());
    return written.taken_differently;
  };
  EXPECT_TRUE(has_part(taken("kp_pid = 30000", "kp_pid = 40000"), "not those of its magnets"));
  EXPECT_TRUE(has_part(taken("i0 = 1", "i0 = [1.0, 2.0]"), "its two axes differ"));
  EXPECT_TRUE(has_part(taken("kp_pid = 30000\nki_pid = 0\nkd_pid = 40", "kp_pid = 0\nkd_pid = 0"),
                       "controller is not in the file"));
  EXPECT_TRUE(has_part(taken("nw = 200", "nw = 0"), "its magnets have no force"));
}

// Coefficients of ROSS's own examples.
TEST(RossMachines, BallAndRollerBearingsAreLinearAndSayWhatTheyCouldBe) {
  const ImportedModel written = imported(on_a_shaft(
      "[BallBearingElement_ball]\nn = 1\nn_balls = 8\nd_balls = 0.03\nfs = 500.0\nalpha = 0.5\n"
      "kxx = [4.64168838e7]\nkyy = [1.00906269e8]\ncxx = [580.2]\ncyy = [1261.3]\n"
      "[RollerBearingElement_roller]\nn = 2\nn_rollers = 8\nl_rollers = 0.03\nfs = 500.0\nalpha = "
      "0.5\nkxx = [2.72821927e8]\nkyy = [5.56779444e8]\ncxx = [3410.3]\ncyy = [6959.7]\n"));
  const auto& bearings = model_in_files(written).structure.bearings;
  EXPECT_EQ(coefficients(bearings.at(1).coefficients, 0.0).K(1, 1), 1.00906269e8);
  EXPECT_EQ(coefficients(bearings.at(2).coefficients, 0.0).K(0, 0), 2.72821927e8);
  EXPECT_TRUE(has_part(written.taken_differently,
                       "the ball bearing \"ball\" is linear, with ROSS's stiffness at 500 N; a "
                       "[[rolling_bearing]] with elements = 8, element_diameter = 0.03"));
  EXPECT_TRUE(has_part(written.taken_differently, "roller_length = 0.03"));
  EXPECT_EQ(written.left_out, std::vector<std::string>{"colors and sizes of pictures"});
}

TEST(RossMachines, SaysAtOnceWhatCoefficientsComeFrom) {
  const ImportedModel written = imported(
      on_a_shaft("[PlainJournal_a]\nn = 1\nkxx = 1e7\njournal_radius = 0.1\naxial_length = 0.1\n"
                 "[PlainJournal_b]\nn = 2\nkxx = 1e7\njournal_radius = 0.1\naxial_length = 0.1\n"));
  EXPECT_EQ(written.left_out.at(0),
            "of PlainJournal: what its coefficients come from (axial_length, journal_radius)");
}

}  // namespace whirl::ross_machines_test
