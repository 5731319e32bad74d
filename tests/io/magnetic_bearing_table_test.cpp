// [[magnetic_bearing]] in model files.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::magnetic_bearing_table_test {

const std::string machine = R"(format = 1
[[body]]
name = "rotor"
mass = 10
spins = true
[[body]]
name = "sensor ring"
mass = 1
[[link]]
from = "sensor ring"
to = "ground"
stiffness = 1e8
[[magnetic_bearing]]
name = "magnet"
body = "rotor"
current_stiffness = "200 N/A"
negative_stiffness = "1 MN/m"
)";

constexpr Complex s{-3.0, 400.0};

Support magnet(const std::string& lines) {
  return parse_model(machine + lines).structure.supports.at(0);
}

void expect_near(Complex found, Complex expected) {
  EXPECT_LT(std::abs(found - expected), 1e-11 * std::abs(expected)) << found << expected;
}

// ki (P + D s) of the sensors, -ks of the motion itself, along both axes
TEST(MagneticBearingTable, HasAxesAndSensors) {
  const Support support = magnet(
      "sensor = \"sensor ring\"\nangle = \"45 deg\"\n"
      "proportional = \"10 A/mm\"\nderivative = \"20 A.s/m\"\n");
  ASSERT_EQ(support.sees.size(), 4u);
  EXPECT_EQ(support.sensors, 2);
  EXPECT_EQ(support.sees[0].at.body, "sensor ring");
  EXPECT_EQ(support.sees[2].at.body, "rotor");
  EXPECT_DOUBLE_EQ(support.acts_on[0].x, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(support.acts_on[1].x, -std::sqrt(0.5));
  const CMat f = support.law.stiffness_at(s);
  expect_near(f(0, 0), 200.0 * (1e4 + 20.0 * s));
  expect_near(f(0, 2), -1e6);
  EXPECT_EQ(f(0, 1), 0.0);
  EXPECT_EQ(f(1, 2), 0.0);
}

TEST(MagneticBearingTable, LoopsHaveFiltersBandwidthsAndDelay) {
  const Complex f = magnet(
                        "proportional = 1e4\nderivative = 20\nintegral = 3e5\n"
                        "derivative_bandwidth = \"5000 rad/s\"\n"
                        "filters = [{ kind = \"notch\", frequency = \"900 rad/s\", depth = 0.2 }]\n"
                        "amplifier_bandwidth = 9000\nsensor_bandwidth = 8000\n"
                        "delay = \"100 us\"\npade_order = 6\n")
                        .law.stiffness_at(s)(0, 0);
  const double w = 900.0;
  const Complex pid = 1e4 + 3e5 / s + 20.0 * s / (1.0 + s / 5000.0);
  const Complex notch = (s * s + 0.2 * 1.4 * w * s + w * w) / (s * s + 1.4 * w * s + w * w);
  expect_near(
      f, 200.0 * pid * notch * 9000.0 / (s + 9000.0) * 8000.0 / (s + 8000.0) * std::exp(-1e-4 * s));
}

TEST(MagneticBearingTable, ControllersMayBeAnyLaw) {
  expect_near(magnet("numerator = [20, 1e4]\ndenominator = [1]\namplifier_bandwidth = 2000\n")
                  .law.stiffness_at(s)(0, 0),
              200.0 * (1e4 + 20.0 * s) * 2000.0 / (s + 2000.0));
  const Support both = magnet(
      "A = [[-100, 0], [0, -200]]\nB = [[1, 0], [0, 1]]\nC = [[5, 6], [7, 8]]\n"
      "D = [[1e4, 2], [3, 1e4]]\ndelay = \"10 us\"\n");
  expect_near(both.law.stiffness_at(s)(0, 1),
              200.0 * (2.0 + 6.0 / (s + 200.0)) * std::exp(-1e-5 * s));
}

// Limits leave the linear law as it is; each axis has a contact for its own, behind all others.
TEST(MagneticBearingTable, HasLimitsOfCurrentAndVoltage) {
  const std::string control =
      "proportional = 1e4\nderivative = 20\nderivative_bandwidth = 5000\n"
      "amplifier_bandwidth = 2000\n";
  const Support plain = magnet(control);
  const Support current = magnet(control + "current_limit = \"3 A\"\n");
  const Support voltage = magnet(
      control + "voltage_limit = \"80 V\"\ninductance = \"20 mH\"\nresistance = \"500 mohm\"\n");
  EXPECT_TRUE(plain.limits.empty());
  for (const Support* support : {&current, &voltage}) {
    ASSERT_EQ(support->limits.size(), 2u);
    expect_near(support->law.stiffness_at(s)(0, 0), plain.law.stiffness_at(s)(0, 0));
    expect_near(support->law.stiffness_at(s)(1, 3), plain.law.stiffness_at(s)(1, 3));
  }
  EXPECT_EQ(current.limits[1].name, "current of axis 2");
  EXPECT_DOUBLE_EQ(current.limits[1].limit, 3.0);
  EXPECT_DOUBLE_EQ(current.limits[1].force, 200.0);
  EXPECT_DOUBLE_EQ(voltage.limits[0].limit, 80.0);
  EXPECT_DOUBLE_EQ(voltage.limits[0].force, 200.0 / (0.02 * 2000.0));
  EXPECT_EQ(
      magnet(control + "current_limit = 3\nvoltage_limit = 80\ninductance = 0.02\n").limits.size(),
      4u);
  const Model model = parse_model(machine + control + "current_limit = 3\n" +
                                  "[[contact]]\nname = \"touch-down\"\nbody = \"rotor\"\n"
                                  "clearance = \"0.2 mm\"\nstiffness = \"10 MN/m\"\n");
  ASSERT_EQ(model.contacts.size(), 3u);
  EXPECT_EQ(model.contacts[0].name, "touch-down");
  EXPECT_EQ(model.contacts[2].name, "magnet, current of axis 2");
  EXPECT_EQ(stator_contacts(model.contacts).size(), 1u);
}

TEST(MagneticBearingTable, WrongControllersAreToldWithTheirPlace) {
  const auto told = [](const std::string& lines, const char* key, const char* words) {
    try {
      magnet(lines);
      ADD_FAILURE() << "it is read: " << lines;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.problems().size(), 1u) << error.what();
      EXPECT_EQ(error.problems().front().key, std::string("magnetic_bearing.magnet.") + key);
      EXPECT_NE(error.problems().front().message.find(words), std::string::npos) << error.what();
    }
  };
  told("", "proportional", "missing, expected a controller");
  told("proportional = 1\nnumerator = [1]\ndenominator = [1, 1]\n", "proportional", "twice");
  told("numerator = [1, 0, 0]\ndenominator = [1]\n", "numerator", "square of the frequency");
  told("proportional = 1\npade_order = 30\n", "pade_order", "up to 20");
  told("proportional = \"1 N/m\"\n", "proportional", "current per displacement");
  const std::string good = "proportional = 1e4\nderivative = 20\nderivative_bandwidth = 5000\n";
  told(good + "voltage_limit = 9\namplifier_bandwidth = 9\n", "inductance", "of the coil");
  told(good + "voltage_limit = 9\ninductance = 1\n", "amplifier_bandwidth", "current loop");
  told(good + "inductance = 1\n", "inductance", "voltage_limit only");
  told("proportional = 1\nderivative = 1\ncurrent_limit = 1\namplifier_bandwidth = 9\n",
       "amplifier_bandwidth", "derivative_bandwidth");
  told("A = [[-1]]\nB = [[1, 2, 3]]\nC = [[1]]\n", "A", "3 displacements and 1 currents");
}

}  // namespace whirl::magnetic_bearing_table_test
