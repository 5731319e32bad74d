// Forces in model files: every form, and what is said of a wrong one.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/problems.hpp"

namespace whirl::test {
namespace model_forces_test {

constexpr double pi = std::numbers::pi;

const std::string body = "format = 1\n[[body]]\nname = \"b\"\nmass = 1\n[[force]]\n";

TEST(ModelForces, AreReadInEveryForm) {
  const auto force = [](const std::string& keys) {
    return parse_model(body + keys).structure.forces.at(0);
  };
  const Force constant = force("body = \"b\"\nforce = \"2 kN\"\nangle = \"-90 deg\"\n");
  EXPECT_EQ(constant.name, "force 1");
  EXPECT_EQ(constant.kind, ForceKind::force);
  EXPECT_EQ(constant.size, 2000.0);
  EXPECT_DOUBLE_EQ(constant.angle, -pi / 2.0);
  EXPECT_TRUE(constant.is_constant());
  EXPECT_EQ(constant.at.body, "b");
  const Force order =
      force("name = \"misalignment\"\nbody = \"b\"\nforce = 3\norder = 2\nphase = \"30 deg\"\n");
  EXPECT_EQ(order.name, "misalignment");
  EXPECT_EQ(order.order, 2.0);
  EXPECT_DOUBLE_EQ(order.phase, pi / 6.0);
  EXPECT_FALSE(order.is_constant() || order.is_synchronous());
  const Force turning = force("body = \"b\"\nforce = 3\norder = 1\nwhirl = \"backward\"\n");
  EXPECT_EQ(turning.turning, Turning::backward);
  EXPECT_TRUE(turning.is_synchronous());
  const Force base = force("base_acceleration = \"9.81 m/s^2\"\nfrequency = \"40 Hz\"\n");
  EXPECT_EQ(base.kind, ForceKind::base_acceleration);
  EXPECT_DOUBLE_EQ(base.frequency, 80.0 * pi);
  EXPECT_FALSE(base.has_station());
  const Force moment = parse_model(
                           "format = 1\n[[body]]\nname = \"b\"\nmass = 1\ntilts = true\n"
                           "[[force]]\nbody = \"b\"\nmoment = \"5 N.m\"\n")
                           .structure.forces.at(0);
  EXPECT_EQ(moment.kind, ForceKind::moment);
}

TEST(ModelForces, ProblemsNameTheirLines) {
  const auto wrong = [](const std::string& keys) { return joined(problems(body + keys)); };
  const std::string at = "body = \"b\"\n";
  const std::string one_of = "one of force (N), moment (N.m) and base_acceleration (m/s^2)";
  EXPECT_EQ(wrong(at), "m:5:1: force.1.force: missing, expected " + one_of + "\n");
  EXPECT_EQ(wrong(at + "force = 1\nmoment = 1\n"),
            "m:8:10: force.1.moment: found force too, expected " + one_of +
                "\n"
                "m:8:10: force.1.moment: this body does not tilt; give it tilts = true\n");
  EXPECT_EQ(wrong("force = 1\n"),
            "m:5:1: force.1.at: missing, expected a station: at = position, node = number, or "
            "body = name\n");
  EXPECT_EQ(wrong(at + "force = \"1 kg\"\n"),
            "m:7:9: force.1.force: found \"1 kg\", expected a force (N)\n");
  EXPECT_EQ(wrong(at + "force = 1\norder = -1\n"),
            "m:8:9: force.1.order: found -1, expected a number without unit above zero\n");
  EXPECT_EQ(wrong(at + "force = 1\nfrequency = \"0 Hz\"\n"),
            "m:8:13: force.1.frequency: found \"0 Hz\", expected a speed (rad/s) above zero\n");
  EXPECT_EQ(wrong(at + "force = 1\norder = 1\nfrequency = \"4 Hz\"\n"),
            "m:9:13: force.1.frequency: found order too, expected one of order (of the speed) and "
            "frequency (its own)\n");
  EXPECT_EQ(wrong(at + "force = 1\nphase = 1\n"),
            "m:8:9: force.1.phase: a force without order and frequency is constant; give one of "
            "them\n");
  EXPECT_EQ(wrong(at + "force = 1\nwhirl = \"forward\"\n"),
            "m:8:9: force.1.whirl: a force without order and frequency is constant; give one of "
            "them\n");
  EXPECT_EQ(wrong(at + "force = 1\norder = 1\nwhirl = \"forward\"\nangle = 1\n"),
            "m:10:9: force.1.angle: a force that whirls turns; phase says where it points at t = "
            "0\n");
  EXPECT_EQ(
      wrong(at + "force = 1\norder = 1\nwhirl = \"forwards\"\n"),
      "m:9:9: force.1.whirl: found \"forwards\", expected one of forward, backward; did you mean "
      "\"forward\"?\n");
  EXPECT_EQ(wrong("base_acceleration = 1\n" + at),
            "m:7:8: force.1.body: the base moves under everything: it has no station\n");
  EXPECT_EQ(wrong(at + "moment = 1\n"),
            "m:7:10: force.1.moment: this body does not tilt; give it tilts = true\n");
  EXPECT_EQ(wrong(at + "force = 1\nfrequenzy = 1\n"),
            "m:8:1: force.1.frequenzy: unknown key, did you mean \"frequency\"?\n");
  EXPECT_EQ(joined(problems("format = 1\n[force]\nforce = 1\n[[body]]\nname = \"b\"\nmass = 1\n")),
            "m:2:2: force: expected an array of tables: write [[force]]\n");
}

}  // namespace model_forces_test
}  // namespace whirl::test
