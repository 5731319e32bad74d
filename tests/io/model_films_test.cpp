// Reading [[oil_film]]: units, defaults, and every mistake with its place.

#include <gtest/gtest.h>

#include <string>

#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::model_films_test {

const std::string rotor = R"(format = 1
[operation]
speed = 300
[[body]]
name  = "journal"
mass  = 2
spins = true
[[body]]
name = "housing"
mass = 5
[[bearing]]
body      = "housing"
stiffness = "10 MN/m"
)";

const std::string film = R"([[oil_film]]
body      = "journal"
radius    = "25 mm"
length    = "12 mm"
clearance = "0.11 mm"
viscosity = "18 mPa.s"
)";

TEST(OilFilmTable, IsReadInItsUnits) {
  const Model model = parse_model(
      rotor + film + "against = \"housing\"\noffset = [\"1 um\", 2e-6]\n" +
          "[[oil_film]]\nname = \"second\"\nlaw = \"short\"\n" + film.substr(film.find("body")),
      "test");
  ASSERT_EQ(model.films.size(), 2u);
  const OilFilm& first = model.films[0];
  EXPECT_EQ(first.name, "oil film 1");
  EXPECT_EQ(model.films[1].name, "second");
  EXPECT_EQ(first.against.body, "housing");
  EXPECT_EQ(first.at.body, "journal");
  EXPECT_DOUBLE_EQ(first.bearing.radius, 0.025);
  EXPECT_DOUBLE_EQ(first.bearing.length, 0.012);
  EXPECT_DOUBLE_EQ(first.bearing.clearance, 1.1e-4);
  EXPECT_DOUBLE_EQ(first.bearing.viscosity, 0.018);
  EXPECT_DOUBLE_EQ(first.offset(0), 1e-6);
  EXPECT_DOUBLE_EQ(first.offset(1), 2e-6);
  const Scene scene = make_scene(model);
  EXPECT_EQ(scene.contacts.films().size(), 2u);
  EXPECT_DOUBLE_EQ(scene.contacts.length_scale(), 1.1e-4);
}

TEST(OilFilmTable, OfADamperHasItsKeysAndASpring) {
  std::string text = rotor + film;
  text.replace(text.find("spins = true\n"), 13, "");  // a ring that does not turn
  const Model plain = parse_model(text + "law = \"squeeze\"\n", "test");
  EXPECT_EQ(formula_of(plain.films.at(0).law), formula_of(AnyFilmLaw(Squeeze{})));
  EXPECT_EQ(plain.structure.bearings.size(), 1u);
  const Model model = parse_model(text +
                                      "law = \"squeeze\"\ntheory = \"long\"\nextent = \"full\"\n"
                                      "spring = \"2 MN/m\"\nagainst = \"housing\"\n",
                                  "test");
  const Squeeze expected{.theory = FilmTheory::long_bearing, .extent = FilmExtent::full};
  EXPECT_EQ(formula_of(model.films.at(0).law), formula_of(AnyFilmLaw(expected)));
  ASSERT_EQ(model.structure.bearings.size(), 2u);
  const Connection& spring = model.structure.bearings[1];
  EXPECT_EQ(spring.name, "oil film 1 spring");
  EXPECT_EQ(spring.from.body, "journal");
  EXPECT_EQ(spring.to.body, "housing");
  EXPECT_EQ(coefficients(spring.coefficients, 0.0).K, Mat2(2e6 * Mat2::Identity()));
}

TEST(OilFilmTable, SaysWhetherItIsLinearized) {
  EXPECT_TRUE(parse_model(rotor + film, "test").films[0].is_linearized);
  EXPECT_FALSE(parse_model(rotor + film + "linearize = false\n", "test").films[0].is_linearized);
}

/// The complaint about a model that is wrong.
std::string complaint(const std::string& text) {
  try {
    make_scene(parse_model(text, "test"));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

void expect_complaint(const std::string& text, const std::string& about) {
  const std::string found = complaint(text);
  EXPECT_NE(found.find(about), std::string::npos) << found << "\nfor\n" << text;
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = rotor + film;
  const auto at = text.find(from, rotor.size());
  return text.replace(at, from.size(), to);
}

TEST(OilFilmTable, TellsWhatIsWrong) {
  expect_complaint(changed("viscosity = \"18 mPa.s\"", ""), "viscosity: missing");
  expect_complaint(changed("18 mPa.s", "18 mPa"), "oil_film.1.viscosity");
  expect_complaint(changed("\"25 mm\"", "0"), "oil_film.1.radius");
  expect_complaint(changed("\"0.11 mm\"", "-1e-4"), "oil_film.1.clearance");
  expect_complaint(changed("length ", "lenght "), "did you mean \"length\"");
  expect_complaint(changed("body      = \"journal\"", ""), "oil_film.1.at: missing");
  expect_complaint(changed("\"journal\"", "\"jornal\""), "did you mean \"journal\"");
  expect_complaint(changed("\"journal\"", "\"housing\""), "spins = true");
  expect_complaint(rotor + film + "against = \"journal\"", "its own bearing");
  expect_complaint(rotor + film + "law = \"long\"", "oil_film.1.law");
  expect_complaint(rotor + film + "law = \"squeeze\"\ntheory = \"wide\"", "oil_film.1.theory");
  expect_complaint(rotor + film + "law = \"squeeze\"\nextent = \"third\"", "oil_film.1.extent");
  expect_complaint(rotor + film + "law = \"squeeze\"\nspring = -1", "oil_film.1.spring");
  expect_complaint(rotor + film + "spring = 1", "oil_film.1.spring: unknown key");
  expect_complaint(rotor + film + "linearize = 1", "oil_film.1.linearize");
  expect_complaint(rotor + film + "offset = 1", "oil_film.1.offset");
  expect_complaint(rotor + "[oil_film]\nbody = \"journal\"\n", "[[oil_film]]");
  EXPECT_NE(complaint(rotor + film + "against = \"journal\"").find("test:20"), std::string::npos);
}

// Without speed a film carries no weight, and there is no sag to start from; gravity or not.
TEST(OilFilmTable, LetsARotorStartOnItsFilms) {
  const std::string heavy = "gravity = 9.81\n" + rotor + film;
  const Model model = parse_model(heavy, "test");
  const Scene scene = make_scene(model);
  const MotionState start = start_state(model, scene, nullptr);
  EXPECT_EQ(scene.contacts.left_bearing(start.y.data()), nullptr);
  EXPECT_LT(start.y(1), 0.0);
  const Model still = parse_model(heavy, "test", {"operation.speed=0"});
  const Scene at_rest = make_scene(still);
  EXPECT_THROW(start_state(still, at_rest, nullptr), NumericalError);
}

}  // namespace whirl::model_films_test
