// A journal on its film as a result, and a rotor at rest on films and bearings: what they carry is
// the weight, and the numbers of a film are those of its place.

#include "libdyn/system/running_film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libdyn/system/resting_rotor.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl::running_film_test {

using std::numbers::pi;
using test::MassOnFilm;

constexpr double rounding = 1e-11;  ///< relative

/// A film at a place, over the clearance from the middle of its bearing.
RunningFilm film_at(const MassOnFilm& p, const Vec2& place) {
  return running_film(p.model().films[0], p.Omega, p.bearing.clearance * place);
}

// Along x Ocvirk's film carries W_r = 4 s Omega e^2 / Q^2 and, against the spin, W_t = pi s Omega e
// / Q^(3/2): the load leads to the place by the attitude arctan(W_t / W_r).
TEST(RunningFilm, TellsWhatItsPlaceSays) {
  for (const double Omega : {300.0, -200.0}) {
    for (const double e : {0.1, 0.7}) {
      MassOnFilm p{.Omega = Omega, .offset = {3e-3, 4e-3}};  // of the bearing: none of the film
      const RunningFilm film = film_at(p, {e, 0.0});
      const double s = Short::factor(p.bearing), Q = 1.0 - e * e;
      const double along = 4.0 * s * std::abs(Omega) * e * e / (Q * Q),
                   across = -pi * s * Omega * e / std::pow(Q, 1.5), W = std::hypot(along, across);
      EXPECT_EQ(film.name, "film");
      EXPECT_NEAR(film.eccentricity, e, rounding);
      EXPECT_NEAR(film.fx(), along, rounding * W);
      EXPECT_NEAR(film.fy(), across, rounding * W);
      EXPECT_NEAR(film.thickness, (1.0 - e) * p.bearing.clearance, rounding * p.bearing.clearance);
      EXPECT_NEAR(film.attitude, -std::atan2(across, along), rounding);
      EXPECT_NEAR(film.attitude_deg(), film.attitude * 180.0 / pi, 1e-9);
      const double R = p.bearing.radius, L = p.bearing.length, c = p.bearing.clearance,
                   turns = std::abs(Omega) / (2.0 * pi);
      EXPECT_NEAR(film.sommerfeld,
                  p.bearing.viscosity * turns * 2.0 * R * L / W * std::pow(R / c, 2),
                  rounding * film.sommerfeld);
      const double shear =
          2.0 * pi * p.bearing.viscosity * std::abs(Omega) * R * R * R * L / (c * std::sqrt(Q));
      EXPECT_NEAR(film.power_loss, std::abs(Omega) * (shear + 0.5 * e * c * std::abs(across)),
                  rounding * film.power_loss);
    }
  }
}

// What the film carries changes by its stiffness from place to place.
TEST(RunningFilm, HasTheStiffnessOfDifferences) {
  constexpr double of_differences = 1e-7, h = 1e-5;  // over the clearance
  const MassOnFilm p{};
  const Vec2 place(0.3, -0.5);
  const RunningFilm film = film_at(p, place);
  for (const int i : {0, 1}) {
    const Vec2 by = h * Vec2::Unit(i);
    const Vec2 change = (film_at(p, place + by).load - film_at(p, place - by).load) /
                        (2.0 * h * p.bearing.clearance);
    EXPECT_LT((film.stiffness.col(i) - change).norm(), of_differences * film.stiffness.norm());
  }
  EXPECT_EQ(film.stiffness_parts().xy, film.stiffness(0, 1));
  EXPECT_EQ(film.stiffness_parts().yx, film.stiffness(1, 0));
  EXPECT_EQ(film.damping_parts().xx, film.damping(0, 0));
  EXPECT_EQ(film.damping_parts().yy, film.damping(1, 1));
}

TEST(RunningFilm, CarriesNothingWithoutSpin) {
  const RunningFilm film = film_at({.Omega = 0.0}, {0.0, -0.4});
  EXPECT_EQ(film.load, Vec2(Vec2::Zero()));
  EXPECT_NEAR(film.eccentricity, 0.4, rounding);
  EXPECT_TRUE(std::isnan(film.attitude));
  EXPECT_TRUE(std::isnan(film.sommerfeld));
  EXPECT_EQ(film.power_loss, 0.0);
}

// ---- rotors at rest -----------------------------------------------------------------------------

/// A mass on a film, a spring and a seal.
Model held_by_all() {
  Model m = MassOnFilm{}.model();
  m.structure.bearings = {test::bearing(test::body("journal"), test::isotropic(4e5))};
  m.structure.bearings[0].name = "spring";
  m.structure.seals = {test::bearing(test::body("journal"), test::isotropic(1e5))};
  m.structure.seals[0].name = "seal";
  return m;
}

TEST(RestingRotor, IsCarriedByBearingsSealsAndFilms) {
  const Model m = held_by_all();
  const Assembler assembler(m.structure);
  const RestingRotor rotor = resting_rotor(m, assembler, m.speed);
  ASSERT_EQ(rotor.films.size(), 1u);
  ASSERT_EQ(rotor.at_rest.bearings.size(), 2u);
  const double weight = MassOnFilm{}.m * 9.81;
  Vec2 sum = rotor.films[0].load;
  for (const BearingLoad& load : rotor.at_rest.bearings) sum += load.force;
  EXPECT_NEAR(sum(0), 0.0, 1e-9 * weight);
  EXPECT_NEAR(sum(1), -weight, 1e-9 * weight);
  EXPECT_LT(rotor.films[0].fy(), 0.0);
  // springs give way by what they carry, and the journal is where they are
  const Vec2 place = rotor.films[0].place;
  EXPECT_LT((rotor.at_rest.bearings[0].force - 4e5 * place).norm(), 1e-9 * weight);
  EXPECT_LT((Vec2(rotor.at_rest.displacement.head<2>()) - place).norm(), 1e-9 * place.norm());
}

TEST(RestingRotor, HasTheLoadsOfJournalsBearingsFirst) {
  const Model m = held_by_all();
  const RestingRotor rotor = resting_rotor(m, Assembler(m.structure), m.speed);
  const auto loads = rotor.journal_loads(m);
  ASSERT_EQ(loads.size(), 2u);  // a seal is none
  EXPECT_EQ(loads[0].name, "spring");
  EXPECT_EQ(loads[0].force, rotor.at_rest.bearings[0].force);
  EXPECT_EQ(loads[1].name, "film");
  EXPECT_EQ(loads[1].force, rotor.films[0].load);
}

TEST(RestingRotor, SagsOnItsSpringsWithoutFilms) {
  Model m = held_by_all();
  m.films.clear();
  const RestingRotor rotor = resting_rotor(m, Assembler(m.structure), m.speed);
  EXPECT_TRUE(rotor.films.empty());
  const double weight = MassOnFilm{}.m * 9.81;
  EXPECT_NEAR(rotor.at_rest.displacement(1), -weight / 5e5, rounding * weight / 5e5);
  EXPECT_EQ(rotor.journal_loads(m).size(), 1u);
}

}  // namespace whirl::running_film_test
