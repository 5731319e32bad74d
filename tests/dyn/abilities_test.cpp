// What systems need and who cannot compute it: one comparison, one sentence, one table in the
// manual.

#include "libdyn/system/abilities.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "libbase/error.hpp"
#include "libdyn/methods/methods.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::abilities_test {

using namespace test;

/// Everybody who says what they cannot do.
std::vector<Abilities> everybody() {
  std::vector<Abilities> all;
  for (const std::string_view name : method_names()) {
    all.push_back(abilities_of(method_named(name)));
  }
  for (const Abilities& a : {orbit_abilities, branch_abilities, rotating_abilities}) {
    all.push_back(a);
  }
  return all;
}

std::string table() {
  std::string text = "| not possible with |";
  for (const Abilities& a : everybody()) {
    if (!a.cannot.empty()) text += fmt::format(" {} |", a.who);
  }
  text += "\n|---|";
  for (const Abilities& a : everybody()) {
    if (!a.cannot.empty()) text += "---|";
  }
  for (const Need need : needs) {
    text += fmt::format("\n| {} |", name_of(need));
    for (const Abilities& a : everybody()) {
      if (!a.cannot.empty()) text += a.can(need) ? " |" : " x |";
    }
  }
  return text + "\n";
}

TEST(Abilities, StandInTheManual) {
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/methods.md");
  std::ostringstream manual;
  manual << file.rdbuf();
  EXPECT_NE(manual.str().find(table()), std::string::npos) << "docs/methods.md should have:\n"
                                                           << table();
}

/// A mass on a spring, with forces.
Scene shaken(std::vector<Force> forces, double Omega = 100.0) {
  Model model;
  model.structure.bodies.push_back({.name = "rotor", .m = 1.0, .spins = true});
  model.structure.bearings.push_back(bearing(body("rotor"), isotropic(1e4, 2.0)));
  for (Force& f : forces) f.at = body("rotor"), f.size = 1.0;
  model.structure.forces = std::move(forces);
  model.speed = Omega;
  return make_scene(model);
}

std::vector<Need> needs_of(const ContactSystem& system) {
  std::vector<Need> found;
  for (const Need need : needs) {
    if (has_need(system, need)) found.push_back(need);
  }
  return found;
}

TEST(Abilities, SystemsSayWhatTheyNeed) {
  using enum Need;
  using Needs = std::vector<Need>;
  EXPECT_EQ(needs_of(shaken({}).contacts), Needs{});
  EXPECT_EQ(needs_of(shaken({{.order = 1.0}}).contacts), Needs{});
  EXPECT_EQ(needs_of(shaken({{.order = 2.0}}).contacts), Needs{other_orders});
  EXPECT_EQ(needs_of(shaken({{.order = 0.5}}).contacts),
            (Needs{other_orders, several_revolutions}));
  EXPECT_EQ(needs_of(shaken({{.order = std::sqrt(2.0)}}).contacts),
            (Needs{other_orders, irrational_orders}));
  EXPECT_EQ(needs_of(shaken({{.frequency = 97.3}}).contacts), Needs{own_frequencies});
  EXPECT_EQ(needs_of(shaken({{.order = 2.0}, {.frequency = 97.3}}).contacts),
            (Needs{other_orders, own_frequencies}));
  EXPECT_EQ(needs_of(MassOnFilm{}.scene().contacts), Needs{films});
  EXPECT_EQ(needs_of(shaken({}, 0.0).contacts), Needs{standstill});
}

TEST(Abilities, OneSentenceRefusesEverySystem) {
  const Scene with_hum = shaken({{.frequency = 97.3}}), plain = shaken({{.order = 1.0}});
  for (const Abilities& a : everybody()) {
    EXPECT_TRUE(a.can(plain.contacts)) << a.who;
    EXPECT_NO_THROW(a.require(plain.contacts)) << a.who;
    EXPECT_EQ(a.refusal(plain.contacts), "") << a.who;
    EXPECT_EQ(a.can(with_hum.contacts), a.can(Need::own_frequencies)) << a.who;
    if (a.can(Need::own_frequencies)) continue;
    try {
      a.require(with_hum.contacts);
      FAIL() << a.who;
    } catch (const ModelError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find(a.who), std::string::npos) << said;
      EXPECT_NE(said.find("not possible with a force with a frequency of its own"),
                std::string::npos)
          << said;
      EXPECT_NE(said.find(a.instead), std::string::npos) << said;
    }
  }
}

}  // namespace whirl::abilities_test
