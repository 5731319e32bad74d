// What is said of an integration that failed: where it was, what its contacts and journals did, and
// whether a journal has left its bearing.

#include "libdyn/system/failure_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::failure_text_test {

using test::MassInRing;
using test::MassOnFilm;

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

TEST(FailureText, SaysWhereTheMotionIs) {
  const MassInRing p{.Omega = 100.0, .mu = 0.2, .R = 0.01};
  const Scene scene = p.scene();
  MotionState state = test::state_of({1.5e-3, 0.0}, {0.0, -0.75});  // slip 1 m/s - 0.75 m/s
  state.revolution = 12;
  state.phase = 0.5 * std::numbers::pi;
  state.contacts = {{Touch::sliding, 1.0}};
  const std::string text = failure_text(scene.contacts, state, "the step is too small");
  EXPECT_EQ(text.find("the step is too small"), 0u) << text;
  EXPECT_TRUE(has(text, "in revolution 12 at 0.250 of it")) << text;
  EXPECT_TRUE(has(text, "\"ring\" sliding, 1.5 clearances from its center, slip 0.25 m/s")) << text;
  // the scale of a velocity is the clearance times the speed, 0.1 m/s
  EXPECT_TRUE(has(text, "largest coordinate 7.5 scales")) << text;
}

TEST(FailureText, NamesTheStateOfEveryContact) {
  Model m = MassInRing{}.model();
  const char* const names[] = {"one", "two", "three", "four"};
  for (const int i : {1, 2, 3}) {
    m.contacts.push_back(m.contacts[0]);
    m.contacts.back().name = names[i];
  }
  m.contacts[0].name = names[0];
  const Scene scene = make_scene(m);
  MotionState state = test::state_of({2e-3, 0.0}, {0.0, 0.0});
  state.contacts = {
      {Touch::apart, 1.0}, {Touch::receding, 1.0}, {Touch::sliding, 1.0}, {Touch::sticking, 1.0}};
  const std::string text = failure_text(scene.contacts, state, "no");
  EXPECT_TRUE(has(text, "\"one\" apart")) << text;
  EXPECT_TRUE(has(text, "\"two\" receding")) << text;
  EXPECT_TRUE(has(text, "\"three\" sliding")) << text;
  EXPECT_TRUE(has(text, "\"four\" sticking")) << text;
}

TEST(FailureText, NamesEveryJournal) {
  const MassOnFilm p{};
  const Scene scene = p.scene();
  const double c = p.bearing.clearance;
  const MotionState state = test::state_of({0.0, -0.75 * c}, {0.0, 0.0});
  const std::string text = failure_text(scene.contacts, state, "no");
  EXPECT_TRUE(has(text, "\"film\" at 0.75 of its clearance")) << text;
  EXPECT_TRUE(has(left_bearing_text(scene.contacts.films()[0]), "\"film\""));
}

// A failure is that of the journal, where one has left its bearing.
TEST(FailureText, FailsByTheJournalThatLeft) {
  const MassOnFilm p{};
  const Scene scene = p.scene();
  const double c = p.bearing.clearance;
  for (const double e : {0.5, 1.25}) {
    Integration result;
    fail(result, scene.contacts, test::state_of({0.0, e * c}, {0.0, 0.0}), Outcome::step_too_small,
         "some reason");
    EXPECT_EQ(result.outcome, e < 1.0 ? Outcome::step_too_small : Outcome::left_bearing);
    EXPECT_EQ(has(result.failure.text(), "some reason"), e < 1.0) << result.failure;
    EXPECT_EQ(has(result.failure.text(), left_bearing_text(scene.contacts.films()[0])), e > 1.0)
        << result.failure;
  }
}

// Displacements by the clearance; a velocity may be anything.
TEST(IsBoundless, BeyondAllBounds) {
  const MassInRing p{};
  const Scene scene = p.scene();
  const double bound = boundless * p.clearance;
  for (const int i : {0, 1}) {
    for (const double sign : {1.0, -1.0}) {
      Vec y = Vec::Zero(4);
      y(i) = 0.999 * sign * bound;
      y(2 + i) = 1e3 * bound;
      EXPECT_FALSE(is_boundless(scene.contacts, y));
      y(i) = 1.001 * sign * bound;
      EXPECT_TRUE(is_boundless(scene.contacts, y));
      y(i) = sign * std::numeric_limits<double>::infinity();
      EXPECT_TRUE(is_boundless(scene.contacts, y));
    }
  }
}

// Nor is it a motion where a single displacement is no number, whichever it is.
TEST(IsBoundless, WhereADisplacementIsNoNumber) {
  const Scene scene = test::RotorStator{}.scene();
  for (int i = 0; i < 4; ++i) {
    Vec y = Vec::Zero(8);
    y(i) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_boundless(scene.contacts, y)) << i;
  }
  EXPECT_TRUE(
      is_boundless(scene.contacts, Vec::Constant(8, std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace whirl::failure_text_test
