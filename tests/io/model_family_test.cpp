// Members of a family are to the last bit what reading and reducing the whole model makes of them.

#include "libio/model/model_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::model_family_test {

const std::string two_disk = std::string(WHIRL_SOURCE_DIR) + "/models/two_disk_mac.toml";

ParameterAxis axis(const std::string& text) {
  const auto parsed = parse_axis(text, 0);
  EXPECT_TRUE(parsed) << parsed.problem;
  return *parsed;
}

/// All that a scene is integrated with, as numbers.
std::vector<double> numbers_of(const Scene& scene, double size = 1e-2) {
  const ContactSystem& system = scene.contacts;
  const auto n = system.coordinates();
  Vec y = Vec::Zero(2 * n);
  for (int i = 0; i < 2 * n; ++i) y(i) = size * std::sin(1.0 + i);  // contacts touch
  std::vector<double> numbers{system.phase_rate(), system.length_scale()};
  Vec acceleration(n);
  system.acceleration(0.3, y.data(), acceleration.data());
  numbers.insert(numbers.end(), acceleration.begin(), acceleration.end());
  const Mat map = scene.displacement_map();
  numbers.insert(numbers.end(), map.data(), map.data() + map.size());
  return numbers;
}

/// The whole model with a value of each of two axes.
Model whole_model(const Model& base, const ParameterAxis& first, double a,
                  const ParameterAxis& second, double b) {
  std::vector<std::string> sets = first.assignments_of(a);
  for (const std::string& set : second.assignments_of(b)) sets.push_back(set);
  return parse_model(base.source, base.path, sets);
}

/// Members of a family over some values beside the whole models: scenes and starts. Returns the
/// numbers of every scene.
std::vector<std::vector<double>> members_beside_whole_models(const Model& base,
                                                             const std::string& text,
                                                             double size = 1e-2) {
  SCOPED_TRACE(text);
  const ParameterAxis one = axis(text);
  const ModelFamily family(base, {one});
  std::vector<std::vector<double>> seen;
  for (const double value : one.values) {
    const Model whole = parse_model(base.source, base.path, one.assignments_of(value));
    const Scene expected = make_scene(whole, ReductionEstimate::no);
    const auto scene = family.scene(std::vector{value});
    seen.push_back(numbers_of(*scene, size));
    EXPECT_EQ(seen.back(), numbers_of(expected, size)) << value;
    const Model member = family.model(std::vector{value});
    EXPECT_EQ(member.speed, whole.speed);
    EXPECT_EQ(member.structure.bearings.size(), whole.structure.bearings.size());
    EXPECT_EQ(family.start(member, *scene, nullptr).y, start_state(whole, expected, nullptr).y);
  }
  return seen;
}

TEST(ModelFamily, MembersAreThoseOfTheWholeModel) {
  const Model base = read_model(two_disk);
  const std::string contact = "contact." + base.contacts.at(0).name;
  for (const std::string& text :
       {contact + ".stiffness=1e6,2.5e6 N/m", contact + ".friction=0.05,0.2",
        std::string("operation.speed=3000,4430 rpm"), std::string("gravity=0,9.81 m/s^2"),
        contact + ".node=6,8", std::string("bearing.left.damping=100,500 N.s/m")}) {
    members_beside_whole_models(base, text);
  }
}

// Loads at the same stations: their sizes and angles need neither a new mesh nor, but for a base's
// acceleration and a bow, new shapes.
TEST(ModelFamily, LoadsAreThoseOfTheWholeModel) {
  const std::string with_loads = read_model(two_disk).source + R"(
[[force]]
name = "pull"
node = 5
force = "20 N"
angle = "30 deg"
[[force]]
name = "pump"
node = 5
force = "20 N"
frequency = "40 Hz"
[[force]]
name = "ground"
base_acceleration = "0.1 m/s^2"
frequency = "30 Hz"
[bow]
table = """
position [mm], deflection [um], angle [deg]
0, 0, 0
250, 20, 40
500, 0, 0
"""
)";
  std::string tolerant = with_loads;  // as many modes as the highest frequency asks for
  const std::size_t modes = tolerant.find("modes  = 8");
  ASSERT_NE(modes, std::string::npos);
  tolerant.erase(modes, std::string("modes  = 8").size());
  for (const Model& base : {parse_model(with_loads), parse_model(tolerant)}) {
    for (const char* text :
         {"disk.1.unbalance.offset=0.5,0.7 mm", "disk.1.unbalance.phase=0,90 deg",
          "gravity=0,9.81 m/s^2", "force.pull.force=10,30 N", "force.pull.node=4,5",
          "force.pump.frequency=40,400 Hz", "force.ground.base_acceleration=0.1,0.2 m/s^2"}) {
      const auto seen = members_beside_whole_models(base, text);
      EXPECT_NE(seen.front(), seen.back()) << text;
    }
  }
}

// Values of films, and a spring of theirs, which is one of the rotor's bearings; modes for the
// start are those about the equilibrium on the films.
TEST(ModelFamily, FilmsAreThoseOfTheWholeModel) {
  const Model on_films = read_model(WHIRL_SOURCE_DIR "/models/two_disk_oil_film.toml",
                                    {"start.whirl=[{mode=1,amplitude=1e-6}]"});
  const Model squeezed = parse_model(R"(format = 1
[operation]
speed = 300
[[body]]
name = "rotor"
mass = 10
spins = true
[[unbalance]]
body = "rotor"
moment = 1e-4
[[oil_film]]
name = "damper"
body = "rotor"
law = "squeeze"
radius = 0.05
length = 0.02
clearance = 1e-4
viscosity = 0.01
spring = 1e6
)");
  const auto expect_films = [](const Model& base, const std::string& text) {
    const auto seen = members_beside_whole_models(base, text, 1e-5);
    EXPECT_NE(seen.front(), seen.back()) << text;
  };
  expect_films(on_films, "oil_film.1.viscosity=0.01,0.02 Pa.s");
  expect_films(on_films, "oil_film.2.clearance=0.1,0.12 mm");
  expect_films(squeezed, "oil_film.damper.viscosity=0.01,0.02 Pa.s");
  expect_films(squeezed, "oil_film.damper.spring=1e6,2e6 N/m");
}

// Layers, and a shaft whose table stands in the text by now.
TEST(ModelFamily, LayersAndTablesAreReadAgain) {
  const Model base = parse_model(R"(format = 1
[operation]
speed = 300
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
table = """
length [mm], od [mm], elements
600, 20, 6
"""
[[layer]]
name = "sleeve"
from = 0.2
to = 0.3
material = "steel"
outer_diameter = 0.05
inner_diameter = 0.02
[[bearing]]
at = 0
stiffness = 1e6
[[bearing]]
at = 0.6
stiffness = 1e6
)");
  for (const char* text : {"layer.sleeve.outer_diameter=40,60 mm", "layer.sleeve.to=250,400 mm",
                           "material.steel.density=7000,8000 kg/m^3"}) {
    const auto seen = members_beside_whole_models(base, text);
    EXPECT_NE(seen.front(), seen.back()) << text;
  }
}

TEST(ModelFamily, SeveralParametersGoTogether) {
  const Model base = read_model(two_disk);
  const std::string contact = "contact." + base.contacts.at(0).name;
  const ParameterAxis speed = axis("operation.speed=3000 rpm"),
                      friction = axis(contact + ".friction=0.05");
  const ModelFamily family(base, {speed, friction});
  for (const double rate : {300.0, 400.0}) {
    for (const double mu : {0.0, 0.1}) {
      const Scene expected =
          make_scene(whole_model(base, speed, rate, friction, mu), ReductionEstimate::no);
      EXPECT_EQ(numbers_of(*family.scene(std::vector{rate, mu})), numbers_of(expected));
    }
  }
}

// A rotor that was read from the same values serves again, others do not.
TEST(ModelFamily, ValuesOfTheRotorGoTogetherWithThoseOfContacts) {
  const Model base = read_model(two_disk);
  const std::string contact = "contact." + base.contacts.at(0).name;
  const ParameterAxis stiffness = axis("bearing.left.stiffness=8e6 N/m"),
                      friction = axis(contact + ".friction=0.05");
  const ModelFamily family(base, {stiffness, friction});
  for (const auto& [k, mu] : {std::pair{6e6, 0.0}, std::pair{6e6, 0.1}, std::pair{9e6, 0.1},
                              std::pair{6e6, 0.2}, std::pair{9e6, 0.2}}) {
    const Model whole = whole_model(base, stiffness, k, friction, mu);
    const Model member = family.model(std::vector{k, mu});
    EXPECT_EQ(member.contacts[0].friction.mu, mu);
    EXPECT_EQ(member.source, base.source);
    EXPECT_EQ(numbers_of(*family.scene(member)),
              numbers_of(make_scene(whole, ReductionEstimate::no)));
  }
}

// Other speeds take over what does not depend on them: nothing of damped modes and of a tolerance,
// and of damping that turns with the shaft its matrix alone.
TEST(ModelFamily, SpeedsAreThoseOfTheWholeModel) {
  const std::string models = WHIRL_SOURCE_DIR "/models/";
  const auto base_of = [&](const std::string& name, const std::vector<std::string>& sets) {
    return read_model(models + name, sets);
  };
  std::string tolerant = base_of("two_disk_mac.toml", {}).source;  // as many modes as it asks for
  const std::size_t modes = tolerant.find("modes  = 8");
  ASSERT_NE(modes, std::string::npos);
  tolerant.replace(modes, std::string("modes  = 8").size(), "band = 900");
  for (const Model& base :
       {base_of("two_disk_mac.toml", {}),
        base_of("two_disk_mac.toml", {"reduction.method=\"damped\""}),
        base_of("two_disk_mac.toml", {"material.steel.internal_damping=1e-5"}),
        parse_model(tolerant, "tolerant.toml"), base_of("jeffcott_stator.toml", {}),
        base_of("two_disk_oil_film.toml", {})}) {
    SCOPED_TRACE(base.path);
    const ParameterAxis speed = axis("operation.speed=3000 rpm");
    const ModelFamily family(base, {speed});
    for (const double Omega : {300.0, 460.0, 0.0, 300.0}) {
      const Model whole = parse_model(base.source, base.path, speed.assignments_of(Omega));
      const Scene expected = make_scene(whole, ReductionEstimate::no);
      const auto scene = family.scene(std::vector{Omega});
      EXPECT_EQ(scene->system.Omega, Omega);
      const double size = base.films.empty() ? 1e-2 : 1e-5;  // journals stay in their bearings
      EXPECT_EQ(numbers_of(*scene, size), numbers_of(expected, size)) << Omega;
    }
  }
}

TEST(ModelFamily, RemembersItsLastMembers) {
  const Model base = read_model(two_disk);
  const ModelFamily family(base, {axis("operation.speed=3000 rpm")});
  const auto one = family.scene(std::vector{300.0});
  EXPECT_EQ(family.scene(std::vector{300.0}), one);
  EXPECT_NE(family.scene(std::vector{301.0}), one);
}

TEST(ModelFamily, WrongValuesAreToldAsInTheWholeModel) {
  const Model base = read_model(two_disk);
  const std::string contact = "contact." + base.contacts.at(0).name;
  for (const std::string& text : {contact + ".clearance=-1 mm", contact + ".node=70",
                                  std::string("operation.speed=-3 rpm")}) {
    SCOPED_TRACE(text);
    const ParameterAxis one = axis(text);
    const auto told = [](const auto& f) -> std::string {
      try {
        f();
      } catch (const ModelError& error) {
        return error.what();
      }
      return "nothing";
    };
    const std::string whole =
        told([&] { parse_model(base.source, base.path, one.assignments(0)); });
    EXPECT_NE(whole, "nothing");
    EXPECT_EQ(told([&] { ModelFamily(base, {one}).model(one.values); }), whole);
  }
}

}  // namespace whirl::model_family_test
