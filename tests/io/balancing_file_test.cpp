// Files of balancing: readings by hand in any convention, trial weights that stay or go, slow roll,
// coefficients of the model, and what is said of wrong files.

#include "libio/measured/balancing_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::balancing_file_test {

/// A rotor between two masses on springs, 200 rad/s and less, with unbalance in both.
const std::string machine = R"(format = 1
title = "two masses"
[operation]
speed = "150 rad/s"
[[body]]
name = "fan"
mass = 2
spins = true
[[body]]
name = "pump"
mass = 3
spins = true
[[link]]
name = "shaft"
from = "fan"
to = "pump"
stiffness = 2e4
damping = 10
[[bearing]]
name = "left"
body = "fan"
stiffness = 5e4
damping = 40
[[bearing]]
name = "right"
body = "pump"
stiffness = 4e4
damping = 30
[[unbalance]]
body = "fan"
moment = "200 g.mm"
phase = "40 deg"
[[unbalance]]
body = "pump"
moment = "350 g.mm"
phase = "-70 deg"
)";
BalancingCase parsed(const std::string& text, const BalancingAsked& asked = {}) {
  return parse_balancing_file(text, "balance.toml", parse_model(machine), asked);
}

/// Two planes and two probes of the manual of hsbalance, phases and angles alike.
std::string by_hand(const std::string& phase, const std::string& angles) {
  return "phase = \"" + phase + "\"\nangles = \"" + angles + "\"\n" + R"(
[[plane]]
name = "A"
[[plane]]
name = "B"
[[probe]]
name = "1"
[[probe]]
name = "2"
[[run]]
speed = "3000 rpm"
readings = [{ probe = "1", amplitude = "170 um", phase = "112 deg" },
            { probe = "2", amplitude = 53, phase = "78 deg" }]
[[run]]
speed = "3000 rpm"
weights = [{ plane = "A", mass = "1.15 g", angle = 0 }]
readings = [{ probe = "1", amplitude = "235 um", phase = "94 deg" },
            { probe = "2", amplitude = "0.058 mm", phase = "68 deg" }]
[[run]]
speed = "3005 rpm"
weights = [{ plane = "B", mass = "1.15 g", angle = 0 }]
readings = [{ probe = "1", amplitude = "185 um", phase = "115 deg" },
            { probe = "2", amplitude = "77 um", phase = "104 deg" }]
)";
}

// Phases that lag with angles against rotation, and phases that lead with angles with rotation,
// mean the same in mirror image: weights have the same told angles. Numbers by an independent
// program, in grams.
TEST(BalancingFile, ReadsReadingsByHandInAnyConvention) {
  for (const auto& [phase, angles] :
       {std::pair{"lag", "against rotation"}, {"lead", "with rotation"}}) {
    const BalancingCase read = parsed(by_hand(phase, angles));
    ASSERT_EQ(read.input.places.size(), 2u);
    EXPECT_NEAR(std::abs(read.input.runs[0].readings(0)), 85e-6, 1e-12);  // half of peak to peak
    const Balancing found = balance(read.input);
    EXPECT_NEAR(found.planes[0].mass, 1.979468e-3, 1e-9);
    EXPECT_NEAR(found.planes[0].angle, 236.17037, 1e-5);
    EXPECT_NEAR(found.planes[1].mass, 1.070509e-3, 1e-9);
    EXPECT_NEAR(found.planes[1].angle, 121.84390, 1e-5);
    EXPECT_NEAR(found.readings[0].told_before, 170.0, 1e-9);
    EXPECT_NEAR(found.readings[0].phase_before, 112.0, 1e-9);
    EXPECT_NEAR(found.readings[0].told_after, 0.0, 1e-9);
  }
  const Balancing mixed = balance(parsed(by_hand("lag", "with rotation")).input);
  EXPECT_NEAR(mixed.planes[0].angle, 360.0 - 236.17037, 1e-5);
}

/// What the machine reads with weights, as a run.
std::string run_text(const CVec& V, const std::string& more) {
  std::string text = "[[run]]\nspeed = \"150 rad/s\"\n" + more + "readings = [";
  for (Eigen::Index p = 0; p < V.size(); ++p) {
    text += "{ probe = \"" + std::string(p == 0 ? "x" : "y") +
            "\", amplitude = " + std::to_string(1e9 * std::abs(V(p))) + ", phase = \"" +
            std::to_string(std::arg(V(p)) / degree) + " deg\" }, ";
  }
  return text + "]\n";
}

// A rotor by two complex numbers per probe: trial weights that stay on it, and those that are taken
// off, lead to the same rotor, and runout of a slow roll is none of it.
TEST(BalancingFile, KnowsWhatIsOnTheRotor) {
  CMat A(2, 2);
  A << Complex(2e-3, 1e-3), Complex(.5e-3, -1e-3), Complex(1e-3, -2e-3), Complex(3e-3, .5e-3);
  CVec V(2), runout(2);
  V << Complex(10e-6, 5e-6), Complex(-4e-6, 12e-6);
  runout << Complex(1e-6, 3e-6), Complex(-2e-6, 1e-6);
  CVec w1(2), w2(2);
  w1 << std::polar(2e-3, 30 * degree), 0.0;
  w2 << 0.0, std::polar(1e-3, 100 * degree);
  const std::string head =
      "phase = \"lead\"\nangles = \"with rotation\"\namplitudes = \"peak\"\n"
      "[[plane]]\nname = \"A\"\n[[plane]]\nname = \"B\"\n"
      "[[probe]]\nname = \"x\"\nunit = \"nm\"\n[[probe]]\nname = \"y\"\nunit = \"nm\"\n";
  const auto weights = [](const std::string& list) { return "weights = [" + list + "]\n"; };
  const std::string a = "{ plane = \"A\", mass = \"2 g\", angle = \"30 deg\"",
                    b = "{ plane = \"B\", mass = \"1 g\", angle = \"100 deg\"";
  const Balancing off =
      balance(parsed(head + run_text(V, "") + run_text(V + A * w1, weights(a + "}")) +
                     run_text(V + A * w2, weights(b + "}")))
                  .input);
  const Balancing on =
      balance(parsed(head + run_text(runout, "slow_roll = true\n") + run_text(V + runout, "") +
                     run_text(V + A * w1 + runout, weights(a + ", kept = true }")) +
                     run_text(V + A * w1 + A * w2 + runout, weights(b + ", kept = true }")))
                  .input);
  constexpr double digits = 1e-8;  // of the texts, 1e-15 m by 1e-3 m/kg
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex kept = k == 0 ? w1(0) : w2(1);
    EXPECT_NEAR(std::abs(on.planes[k].weight + kept - off.planes[k].weight), 0.0, digits);
  }
  EXPECT_NEAR(std::abs(on.readings[0].before - (V + A * (w1 + w2))(0)), 0.0, 1e-3 * digits);
  EXPECT_NEAR(std::abs(on.readings[0].after), 0.0, 1e-3 * digits);
}

const std::string planes_at_bodies =
    "angles = \"with rotation\"\n"
    "[[plane]]\nname = \"fan\"\nbody = \"fan\"\nradius = \"100 mm\"\n"
    "[[plane]]\nname = \"pump\"\nbody = \"pump\"\nradius = \"80 mm\"\n"
    "[[probe]]\nname = \"1\"\nbody = \"fan\"\nangle = \"45 deg\"\n"
    "[[probe]]\nname = \"2\"\nbody = \"pump\"\nangle = \"45 deg\"\n"
    "[[probe]]\nname = \"3\"\nbody = \"pump\"\nangle = \"135 deg\"\n";

// The model balances itself: the weights are its unbalances, turned by 180 deg, whatever the speed,
// and nothing is left.
TEST(BalancingFile, BalancesTheModelByItself) {
  const Balancing found = balance(parsed(planes_at_bodies, {.speeds = {150.0, 90.0}}).input);
  EXPECT_TRUE(found.is_of_model);
  ASSERT_EQ(found.readings.size(), 6u);
  EXPECT_NEAR(std::abs(found.planes[0].weight - std::polar(2e-3, -140 * degree)), 0.0, 1e-13);
  EXPECT_NEAR(std::abs(found.planes[1].weight - std::polar(4.375e-3, 110 * degree)), 0.0, 1e-13);
  for (const ReadingBalance& r : found.readings) {
    EXPECT_LT(std::abs(r.after), 1e-10 * std::abs(r.before));
  }
}

// Where the unbalance lets the rotor touch a contact, its vibration is not linear in the unbalance.
TEST(BalancingFile, RefusesAModelThatTouches) {
  const std::string ring =
      "[[contact]]\nname = \"ring\"\nbody = \"fan\"\nclearance = \"1 um\"\nstiffness = 1e6\n";
  const Model model = parse_model(machine + ring);
  const auto read = [&](bool anyway) {
    return parse_balancing_file(planes_at_bodies, "balance.toml", model,
                                {.speeds = {150.0}, .accepts_nonlinear = anyway});
  };
  try {
    read(false);
    ADD_FAILURE() << "is not refused";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("touches contact ring at 1432.39 rpm"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(read(true).notes.size(), 1u);
}

TEST(BalancingFile, TakesGradesAndHoles) {
  const std::string more = "[rotor]\ngrade = \"G2.5\"\nmass = \"40 kg\"\nspeed = \"3000 rpm\"\n";
  std::string text = planes_at_bodies + more;
  text.replace(text.find("radius = \"80 mm\""), 16,
               "radius = \"80 mm\"\nholes = { count = 12, first = \"15 deg\", pieces = [\"1 g\", "
               "\"0.5 g\"], pieces_per_hole = 3 }");
  const Balancing found = balance(parsed(text, {.speeds = {150.0}}).input);
  EXPECT_NEAR(found.permissible, 318.309886e-6, 1e-12);
  EXPECT_NEAR(found.planes[0].permissible, found.permissible / 2.0, 1e-12);
  ASSERT_GE(found.holes.size(), 2u);
  for (const HoleBalance& hole : found.holes) {
    EXPECT_EQ(hole.plane, 1);
    EXPECT_NEAR(std::remainder(hole.angle - 15.0, 30.0), 0.0, 1e-9);
    EXPECT_NEAR(std::remainder(hole.mass, 0.5e-3), 0.0, 1e-12);
  }
  EXPECT_LT(std::abs(found.planes[1].placed - found.planes[1].weight), 0.25e-3);
  EXPECT_NEAR(found.planes[1].left,
              0.08 * std::abs(found.planes[1].placed - found.planes[1].weight), 1e-12);
}

TEST(BalancingFile, SaysWhatIsWrongAndWhere) {
  const std::string good = by_hand("lag", "against rotation");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  const std::pair<std::string, const char*> cases[]{
      {changed("phase = \"lag\"\n", ""), "phase: missing"},
      {changed("angles = \"against rotation\"\n", ""), "angles: missing"},
      {changed("\"against rotation\"", "\"backward\""), "angles: "},
      {changed("plane = \"A\"", "plane = \"C\""), "weights.1.plane"},
      {changed("probe = \"1\"", "probe = \"3\""), "readings.1.probe"},
      {changed("probe = \"2\"", "probe = \"1\""), "two readings of this probe"},
      {changed("\"112 deg\"", "112"), "are radians without a unit"},
      {changed("\"170 um\"", "\"170 kg\""), "amplitude: found"},
      {changed("mass = \"1.15 g\"", "mass = \"-1 g\""), "weights.1.mass"},
      {changed("speed = \"3000 rpm\"\n", ""), "speed: missing"},
      {changed("name = \"B\"", "name = \"A\""), "there are two planes \"A\""},
      {changed("name = \"B\"", "nome = \"B\""), "nome: unknown key"},
      {changed("[[probe]]\nname = \"2\"", "[[probe]]\nname = \"2\"\nunit = \"kg\""), "unit: found"},
      {changed("[[probe]]\nname = \"2\"", "[[probe]]\nname = \"2\"\nunit = \"mm/s\""), "amplitude"},
      {changed("[[plane]]\nname = \"B\"", "[[plane]]\nname = \"B\"\nholes = { most = \"1 g\" }"),
       "angles of the holes"},
      {changed("[[plane]]\nname = \"B\"", "[[plane]]\nname = \"B\"\nbody = \"rotor\""), "rotor"},
      {"angles = \"with rotation\"\n", "expected one [[plane]] or more"},
      {"", ""}};
  for (const auto& [text, part] : cases) {
    try {
      balance(parsed(text).input);
      ADD_FAILURE() << text << "\nis taken";
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << error.what() << "\ndoes not say: " << part;
    }
  }
}

}  // namespace whirl::balancing_file_test
