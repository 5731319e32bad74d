// [[rolling_bearing]] in model files.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "libbase/error.hpp"
#include "libcontact/rolling_bearing.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::rolling_bearing_table_test {

const std::string machine = R"(format = 1
[[body]]
name = "rotor"
mass = 10
spins = true
[[body]]
name = "housing"
mass = 5
[[bearing]]
body = "housing"
stiffness = 1e8
[[rolling_bearing]]
name = "b"
body = "rotor"
)";
const std::string balls =
    "elements = 9\npitch_diameter = \"39.04 mm\"\nelement_diameter = \"7.94 mm\"\n";

Model read(const std::string& lines) {
  return parse_model(machine + lines);
}
const geometry::RollingElements& row(const Model& model) {
  return std::get<geometry::RollingElements>(model.contacts.at(0).geometry);
}

TEST(RollingBearingTable, HasItsElementsAndItsCage) {
  const Model model = read(balls +
                           "to = \"housing\"\nhertz_stiffness = 1e10\nclearance = \"20 um\"\n"
                           "cage_angle = \"90 deg\"\noffset = [1e-6, 2e-6]\n");
  const Contact& bearing = model.contacts.at(0);
  EXPECT_EQ(bearing.name, "b");
  EXPECT_EQ(bearing.against.body, "housing");
  EXPECT_EQ(bearing.offset, Vec2(1e-6, 2e-6));
  EXPECT_DOUBLE_EQ(std::get<Hertz<>>(bearing.law).k, 1e10);
  EXPECT_EQ(row(model).elements, 9);
  EXPECT_DOUBLE_EQ(row(model).play, 1e-5);
  EXPECT_DOUBLE_EQ(row(model).cage, 0.5 * (1.0 - 7.94 / 39.04));
  EXPECT_DOUBLE_EQ(row(model).first, 0.5 * std::numbers::pi);
  EXPECT_TRUE(model.structure.links.empty());
}

// a ball at a contact angle is pressed by u cos, and pushes by Q cos
TEST(RollingBearingTable, LessensTheStiffnessByTheContactAngle) {
  const Model model = read(balls + "hertz_stiffness = 1e10\ncontact_angle = \"40 deg\"\n");
  const double cosine = std::cos(40.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(std::get<Hertz<>>(model.contacts.at(0).law).k, 1e10 * std::pow(cosine, 2.5), 1.0);
  EXPECT_DOUBLE_EQ(row(model).cage, 0.5 * (1.0 - 7.94 * cosine / 39.04));
}

TEST(RollingBearingTable, FindsTheStiffnessFromTheGeometry) {
  const Model model = read(balls + "inner_groove = \"4.09 mm\"\nouter_groove = \"4.13 mm\"\n");
  RollingBearing b;
  b.element_diameter = 7.94e-3;
  b.pitch_diameter = 39.04e-3;
  b.inner_groove = 4.09e-3;
  b.outer_groove = 4.13e-3;
  EXPECT_NEAR(std::get<Hertz<>>(model.contacts.at(0).law).k, element_stiffness(b),
              1e-10 * element_stiffness(b));
  EXPECT_GT(element_stiffness(b), 5e9);
  EXPECT_LT(element_stiffness(b), 2e10);
  // Palmgren, in N and mm: 3.84e-5 Q^0.9 / l^0.8 on each race
  const Model rollers =
      read("kind = \"roller\"\nelements = 12\ncage_ratio = 0.4\nroller_length = \"10 mm\"\n");
  const double k = std::get<Line<>>(rollers.contacts.at(0).law).k;
  const double Q = k * 5e-6 * std::pow(5.0, 1.0 / 9.0);
  EXPECT_NEAR(2.0 * 3.84e-5 * std::pow(Q, 0.9) / std::pow(10.0, 0.8), 5e-3, 1e-12);
}

TEST(RollingBearingTable, HasPreloadDampingWavesAndSpalls) {
  const Model model = read(
      "elements = 8\ncage_ratio = 0.375\nhertz_stiffness = 1e10\npreload = \"4 um\"\ndamping = "
      "200\n"
      "waves = [{ race = \"inner\", order = 9, height = \"1 um\", angle = 0.1 }]\n"
      "spalls = [{ race = \"outer\", width = \"6 deg\", depth = \"20 um\", angle = \"-90 deg\" "
      "}]\n");
  EXPECT_DOUBLE_EQ(row(model).play, -2e-6);
  EXPECT_DOUBLE_EQ(slack_of(row(model)), -3e-6);
  ASSERT_EQ(row(model).shapes.size(), 2u);
  EXPECT_TRUE(row(model).shapes[0].is_inner);
  EXPECT_DOUBLE_EQ(row(model).shapes[0].order, 9.0);
  const geometry::RaceShape& spall = row(model).shapes[1];
  EXPECT_DOUBLE_EQ(spall.height, -20e-6);
  // half is left at half the width
  const double half = 3.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(std::exp(spall.sharpness * (std::cos(half) - 1.0)), 0.5, 1e-12);
  ASSERT_EQ(model.structure.links.size(), 1u);
  EXPECT_EQ(coefficients(model.structure.links[0].coefficients, 0.0).C, 200.0 * Mat2::Identity());
}

TEST(RollingBearingTable, SaysWhatIsWrong) {
  struct Wrong {
    const char *lines, *key, *says;
  };
  const std::string stiff = "hertz_stiffness = 1e10\n";
  for (const Wrong& w : {
           Wrong{"elements = 8\ncage_ratio = 0.4\n", "hertz_stiffness", "inner_groove"},
           Wrong{"elements = 8\nhertz_stiffness = 1\n", "pitch_diameter", "cage_ratio"},
           Wrong{"elements = 2\ncage_ratio = 0.4\nhertz_stiffness = 1\n", "elements", "3 or more"},
           Wrong{"elements = 8\ncage_ratio = 1.4\nhertz_stiffness = 1\n", "cage_ratio",
                 "less than 1"},
           Wrong{"elements = 8\ncage_ratio = 0.4\nhertz_stiffness = 1\nclearance = 1e-5\npreload = "
                 "1e-6\n",
                 "preload", "one of them"},
           Wrong{"elements = 8\ncage_ratio = 0.4\nhertz_stiffness = 1\nroller_length = 1e-2\n",
                 "roller_length", "roller"},
           Wrong{"elements = 8\ncage_ratio = 0.4\nkind = \"roller\"\n", "line_stiffness",
                 "roller_length"},
           Wrong{"elements = 8\npitch_diameter = 0.05\nelement_diameter = 0.03\nhertz_stiffness = "
                 "1\n",
                 "elements", "do not fit"},
           Wrong{"elements = 8\npitch_diameter = 0.05\nelement_diameter = 0.01\ninner_groove = "
                 "0.004\nouter_groove = 0.006\n",
                 "inner_groove", "more than half"},
           Wrong{
               "elements = 8\ncage_ratio = 0.4\nhertz_stiffness = 1\ncontact_angle = \"85 deg\"\n",
               "contact_angle", "80 deg"},
           Wrong{
               "elements = 8\ncage_ratio = 0.4\nhertz_stiffness = 1\nwaves = [{ race = \"inner\", "
               "order = 2.5, height = 1e-6 }]\n",
               "waves.1.order", "whole number"},
           Wrong{"elements = 8\ncage_ratio = 0.4\nhertz_stiffness = 1\nspalls = [{ race = "
                 "\"inner\", width = 2, depth = 1e-6 }]\n",
                 "spalls.1.width", "90 deg"},
       }) {
    try {
      read(w.lines);
      ADD_FAILURE() << w.lines;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.problems().front().key, std::string("rolling_bearing.b.") + w.key) << w.lines;
      EXPECT_NE(error.problems().front().message.find(w.says), std::string::npos)
          << error.problems().front().message;
    }
  }
}

}  // namespace whirl::rolling_bearing_table_test
