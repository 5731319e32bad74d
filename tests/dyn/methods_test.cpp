// The list of integrators, and what every one of them keeps to.

#include "libdyn/methods/methods.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <limits>
#include <set>
#include <string>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::methods_test {

using test::RotorStator;

TEST(Methods, AreFoundByTheirNames) {
  std::set<std::string_view> names;
  for (const std::string_view name : method_names()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(name_of_method(method_named(name)), name);
  }
  EXPECT_EQ(names.size(), std::variant_size_v<AnyMethod>);
  EXPECT_TRUE(std::holds_alternative<CvodeAdams>(method_named("cvode")));
}

TEST(Methods, OfUnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    method_named("dop583");
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("dop853"), std::string::npos) << error.what();
  }
}

class EveryMethod : public ::testing::TestWithParam<std::string_view> {
 protected:
  AnyMethod method() const { return method_named(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, ::testing::ValuesIn(method_names()),
                         [](const auto& member) {
                           std::string name(member.param);
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

// Steps join without gaps, in states that the next step starts from, and end on revolutions.
TEST_P(EveryMethod, GivesStepsThatJoin) {
  constexpr double interpolation = 1e-9;  // of the ends of multistep polynomials; tolerance 1e-10
  const Scene scene = test::P1.scene();
  MotionState state = test::start_of(test::P1.model(), scene);
  test::run(scene, state, 20);
  Vec y = state.y, z(8);
  long revolution = state.revolution;
  double phase = 0.0;
  const Integration result =
      test::run(scene, state, 3, {.method = method()}, [&](const Step& step) {
        if (step.revolution != revolution) {
          EXPECT_NEAR(phase, 2.0 * test::pi, 1e-12);
          EXPECT_EQ(step.phase, 0.0);
          EXPECT_EQ(step.revolution, revolution + 1);
        } else {
          EXPECT_NEAR(step.phase, phase, 1e-12);
        }
        EXPECT_NEAR(step.turn(), step.h * test::P1.Omega, 1e-14);
        step.at(0.0, z.data());
        EXPECT_LT(distance(scene.contacts, y, z), interpolation);
        step.at(1.0, y.data());
        revolution = step.revolution;
        phase = step.angle(1.0);
        return true;
      });
  EXPECT_EQ(result.outcome, Outcome::reached_end);
  EXPECT_EQ(state.revolution, 23);
  EXPECT_EQ(state.phase, 0.0);
  EXPECT_LT(distance(scene.contacts, y, state.y), interpolation);
  EXPECT_GT(result.cost.steps, 0);
  EXPECT_GT(result.cost.evaluations, result.cost.steps);
}

// The dense output follows the motion within its steps: a phase of the revolution reached within
// one of them, and as the end of a motion that starts a little earlier, is the same state.
TEST_P(EveryMethod, InterpolatesWithinItsSteps) {
  const Scene scene = test::P3.scene();  // smooth: no events
  MotionState start = test::start_of(test::P3.model(), scene);
  test::run(scene, start, 30);
  const auto state_at = [&](const AnyMethod& m, double tolerance, double phase) {
    MotionState state = start;
    Vec y(8);
    test::run(scene, state, 1, {.tolerance = tolerance, .method = m}, [&](const Step& step) {
      const double s = (phase - step.phase) / step.turn();
      if (s < 0.0 || s > 1.0) return true;
      step.at(s, y.data());
      return false;
    });
    return y;
  };
  for (const double phase : {0.1, 1.0, 2.0, 3.3, 4.4, 5.9}) {
    EXPECT_LT(distance(scene.contacts, state_at(method(), 1e-10, phase),
                       state_at(Dop853{}, 1e-15, phase)),
              1e-7)  // a dense output may be worse than its steps, by an order or two
        << phase;
  }
}

TEST_P(EveryMethod, StopsWhereTheObserverSays) {
  const Scene scene = test::P1.scene();
  MotionState state = test::start_of(test::P1.model(), scene);
  int steps = 0;
  const Integration result =
      test::run(scene, state, 5, {.method = method()}, [&](const Step&) { return ++steps < 3; });
  EXPECT_EQ(result.outcome, Outcome::stopped_by_observer);
  EXPECT_EQ(result.cost.steps, 3);
  EXPECT_EQ(state.revolution, 0);
  EXPECT_GT(state.phase, 0.0);

  // and goes on from there as if nothing had happened
  const Integration rest = test::run(scene, state, 2, {.method = method()});
  EXPECT_EQ(rest.outcome, Outcome::reached_end);
  EXPECT_EQ(state.revolution, 2);
  EXPECT_EQ(state.phase, 0.0);
  MotionState whole = test::start_of(test::P1.model(), scene);
  test::run(scene, whole, 2);
  EXPECT_LT(distance(scene.contacts, state.y, whole.y), 1e-6);
}

TEST_P(EveryMethod, SaysWhatWentWrongWithAStateThatIsNoNumber) {
  const Scene scene = test::P1.scene();
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (const int entry : {1, 4}) {  // a displacement, a velocity
      MotionState state = test::start_of(test::P1.model(), scene);
      state.y(entry) = bad;
      const Integration result = test::run(scene, state, 5, {.method = method()});
      EXPECT_EQ(result.outcome, Outcome::not_finite);
      EXPECT_NE(result.failure.text().find("revolution"), std::string::npos) << result.failure;
      EXPECT_NE(result.failure.text().find("ring"), std::string::npos) << result.failure;
    }
  }
}

}  // namespace whirl::methods_test
