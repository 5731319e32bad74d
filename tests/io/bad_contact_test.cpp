// Wrong contacts: what a law cannot have, at the key that says so.

#include <gtest/gtest.h>

#include "tests/io/problems.hpp"

namespace whirl::bad_contact_test {

using test::joined, test::problems;

/// A text has one problem, which is told with these words.
void expect_one_problem(const std::string& text, const std::string& part) {
  const auto found = problems(text);
  ASSERT_EQ(found.size(), 1u) << joined(found);
  EXPECT_NE(found[0].find(part), std::string::npos) << found[0];
}

/// A text in which the first of some words is replaced.
std::string replaced(std::string text, const std::string& of, const std::string& becomes) {
  return text.replace(text.find(of), of.size(), becomes);
}

// What a face cannot do, at the key that says so.
TEST(BadContact, KeysThatDoNotGoWithAFace) {
  const std::string body = R"(format = 1
[[body]]
name = "rotor"
mass = 1
spins = true
)",
                    tilts = R"(tilts = true
diametral_inertia = 1
[[contact]]
name = "rim"
law = "face"
body = "rotor"
clearance = 1
stiffness = 1
face_radius = 1
)";
  EXPECT_EQ(joined(problems(body + tilts)), "");
  EXPECT_EQ(joined(problems(body + tilts + "friction = 0.1\nslip = \"forward\"\n")), "");
  EXPECT_EQ(joined(problems(body + tilts + "friction = 0.1\nslip_tolerance = \"1 mm/s\"\n")), "");
  const auto& expect = expect_one_problem;
  expect(body + tilts + "friction = 0.1\n",
         "m:8:1: contact.rim.slip_tolerance: found none, but this contact cannot stick: give a "
         "width to the sign of the slip, such as \"1 mm/s\", or say slip = \"forward\"");
  expect(body + tilts + "friction = 0.1\nslip_tolerance = 0\n",
         "m:16:18: contact.rim.slip_tolerance");
  expect(body + tilts + "radius = 1\n", "m:15:10: contact.rim.radius: the law says where it slips");
  expect(body + tilts + "offset = [0, 0]\n", "m:15:10: contact.rim.offset: a face has none");
  expect(
      body + tilts.substr(tilts.find("[[")),
      "m:9:8: contact.rim.body: a face touches as it tilts, but \"rotor\" does not: give it tilts "
      "= true");
  std::string without = tilts;
  without.erase(without.find("face_radius"));
  expect(body + without, "m:8:1: contact.rim.face_radius: missing, expected a length (m)");
}

TEST(BadContact, KeysOfBladeTips) {
  const std::string text = R"(format = 1
[[body]]
name = "rotor"
mass = 1
spins = true
[[contact]]
name = "tips"
law = "blade-tip"
body = "rotor"
clearance = 1
hertz_stiffness = 1
blades = 3
tip_radius = 2
blade_length = 1
blade_bending_stiffness = 1
blade_line_density = 1
)";
  EXPECT_EQ(joined(problems(text)), "");
  EXPECT_EQ(joined(problems(text + "friction = 0.1\nslip = \"forward\"\n")), "");
  EXPECT_EQ(joined(problems(text + "offset = [0, 0]\n")), "");
  const auto expect = [&](const std::string& of, const std::string& becomes,
                          const std::string& part) {
    expect_one_problem(replaced(text, of, becomes), part);
  };
  expect("blades = 3\n", "", "m:6:1: contact.tips.blades: missing, expected a whole number");
  expect("blades = 3", "blades = 0", "m:12:10: contact.tips.blades: found 0");
  expect("blades = 3", "blades = 2000",
         "m:12:10: contact.tips.blades: found 2000, expected a number up to 1000");
  expect("blades = 3", "blades = 2.5", "m:12:10: contact.tips.blades: found 2.5");
  expect("blade_length = 1", "blade_length = 3",
         "m:14:16: contact.tips.blade_length: is more than the tip_radius");
  expect("blade_length = 1\n", "", "m:6:1: contact.tips.blade_length: missing");
  expect("clearance = 1\n", "clearance = 1\nradius = 1\n",
         "m:11:10: contact.tips.radius: the law says where it slips");
  expect("clearance = 1\n", "clearance = 1\nfriction = 1\n",
         "m:6:1: contact.tips.slip_tolerance: found none");
  expect("hertz_stiffness = 1\n", "stiffness = 1\nhertz_stiffness = 1\n",
         "m:11:1: contact.tips.stiffness: unknown key");
}

TEST(BadContact, KeysOfAnEllipse) {
  const std::string text = R"(format = 1
[[body]]
name = "rotor"
mass = 1
[[contact]]
name = "worn"
geometry = "ellipse"
body = "rotor"
clearance = 1
stiffness = 1
angle = "20 deg"
aspect = 1.25
)";
  EXPECT_EQ(joined(problems(text)), "");
  EXPECT_EQ(joined(problems(text + "friction = 0.1\nradius = 1\nslip = \"forward\"\n")), "");
  const auto expect = [&](const std::string& of, const std::string& becomes,
                          const std::string& part) {
    expect_one_problem(replaced(text, of, becomes), part);
  };
  expect("aspect = 1.25\n", "", "m:5:1: contact.worn.aspect: missing");
  expect("1.25", "0.8", "m:12:10: contact.worn.aspect: found 0.8, expected 1 or more");
  expect("1.25", "-1", "m:12:10: contact.worn.aspect: found -1");
  expect("1.25\n", "1.25\nfriction = 0.1\nradius = 1\n",
         "m:5:1: contact.worn.slip_tolerance: found none, but this contact cannot stick");
  EXPECT_EQ(problems(replaced(text, "ellipse", "ring")),
            (std::vector<std::string>{
                "m:11:9: contact.worn.angle: goes with geometry = \"stop\" or \"ellipse\"",
                "m:12:10: contact.worn.aspect: goes with geometry = \"ellipse\""}));
}

TEST(BadContact, KeysOfAStop) {
  const std::string text = R"(format = 1
[[body]]
name = "rotor"
mass = 1
[[contact]]
name = "snubber"
geometry = "stop"
body = "rotor"
clearance = 1
stiffness = 1
angle = "-90 deg"
)";
  EXPECT_EQ(joined(problems(text)), "");
  EXPECT_EQ(joined(problems(text + "damping = 1\nfriction = 0.1\nradius = 1\noffset = [0, 1]\n")),
            "");
  const auto expect = [&](const std::string& of, const std::string& becomes,
                          const std::string& part) {
    expect_one_problem(replaced(text, of, becomes), part);
  };
  expect("angle = \"-90 deg\"\n", "",
         "m:5:1: contact.snubber.angle: missing, expected an angle (rad)");
  expect("-90 deg", "-90 mm", "m:11:9: contact.snubber.angle: found \"-90 mm\", expected an angle");
  expect("geometry = \"stop\"\n", "",
         "m:10:9: contact.snubber.angle: goes with geometry = \"stop\"");
  expect("\"stop\"", "\"stob\"", "expected one of ring, stop, ellipse; did you mean \"stop\"?");
}

TEST(BadContact, ALawThatIsForAGeometryTakesNoOther) {
  const auto found = problems(R"(format = 1
[[body]]
name = "rotor"
mass = 1
tilts = true
diametral_inertia = 1
[[contact]]
name = "rim"
law = "face"
geometry = "ring"
body = "rotor"
clearance = 1
stiffness = 1
face_radius = 1
)");
  ASSERT_EQ(found.size(), 1u) << joined(found);
  EXPECT_NE(found[0].find("m:10:12: contact.rim.geometry: the law says what it touches"),
            std::string::npos)
      << found[0];
}

TEST(BadContact, FrictionOnABodyNeedsARadius) {
  const std::string text = R"(format = 1
[[body]]
name = "rotor"
mass = 1
[[contact]]
body = "rotor"
clearance = 1
stiffness = 1
)";
  EXPECT_EQ(joined(problems(text)), "");
  EXPECT_EQ(joined(problems(text + "friction = 0.1\nslip = \"forward\"\n")), "");
  EXPECT_EQ(problems(text + "friction = 0.1\n"),
            (std::vector<std::string>{"m:5:1: contact.1.radius: missing, expected a length (m): "
                                      "friction on a body needs the radius of the contact for its "
                                      "slip velocity"}));
}

}  // namespace whirl::bad_contact_test
