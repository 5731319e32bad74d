// Loads of other frequencies than that of the speed: when they repeat, alone and together, and
// which are too fast.

#include "libdyn/system/load_periods.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/excitation.hpp"
#include "tests/support/bladed_disk.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::load_periods_test {

using std::numbers::pi;
using std::numbers::sqrt2;

constexpr double rounding = 1e-11;  ///< relative

/// Forces on a mass at 100 rad/s: of orders of the speed, and of frequencies of their own [Hz].
Scene scene_of(const std::vector<double>& orders, const std::vector<double>& frequencies,
               double unbalance = 0.0, double Omega = 100.0) {
  Model m = test::MassInRing{.Omega = Omega, .c = 5.0, .U = unbalance}.model();
  const auto add = [&](double order, double frequency) {
    m.structure.forces.push_back({.name = "push",
                                  .at = test::body("mass"),
                                  .size = 2.0,
                                  .order = order,
                                  .frequency = frequency});
  };
  for (const double order : orders) add(order, 0.0);
  for (const double frequency : frequencies) add(0.0, 2.0 * pi * frequency);
  return make_scene(m);
}

TEST(LoadPeriods, FollowTheSpeedWhereSomethingTurns) {
  EXPECT_FALSE(follows_the_speed(scene_of({}, {}).contacts));
  EXPECT_FALSE(follows_the_speed(scene_of({}, {30.0}).contacts));
  EXPECT_TRUE(follows_the_speed(scene_of({}, {}, 1e-4).contacts));
  EXPECT_TRUE(follows_the_speed(scene_of({1.0}, {}).contacts));
  EXPECT_FALSE(follows_the_speed(scene_of({}, {}, 1e-4, 0.0).contacts));  // it stands still
  Model blades = test::bladed_disk();
  blades.structure.unbalances.clear();
  EXPECT_TRUE(follows_the_speed(make_scene(blades).contacts));
}

TEST(LoadPeriods, HaveAPeriodOfTheirOwn) {
  const auto period = [](const std::vector<double>& frequencies) {
    const auto t = load_period(scene_of({}, frequencies).contacts);
    EXPECT_TRUE(t);
    return t.value_or(0.0);
  };
  EXPECT_NEAR(period({30.0}), 1.0 / 30.0, rounding);
  EXPECT_NEAR(period({20.0, 30.0}), 0.1, rounding);
  EXPECT_NEAR(period({30.0, 20.0, 25.0}), 0.2, rounding);
}

TEST(LoadPeriods, HaveNoPeriodBesideTheSpeedOrWithoutARatio) {
  EXPECT_FALSE(load_period(scene_of({}, {}).contacts));
  EXPECT_FALSE(load_period(scene_of({}, {30.0}, 1e-4).contacts));
  EXPECT_FALSE(load_period(scene_of({2.0}, {}).contacts));
  EXPECT_FALSE(load_period(scene_of({}, {10.0, 10.0 * sqrt2}).contacts));
}

TEST(LoadPeriods, RepeatWithRevolutionsOrWithoutThem) {
  const auto repeats = [](const std::vector<double>& orders, const std::vector<double>& frequencies,
                          double unbalance) {
    return loads_repeat(scene_of(orders, frequencies, unbalance).contacts);
  };
  EXPECT_TRUE(repeats({}, {}, 1e-4));
  EXPECT_TRUE(repeats({0.5, 3.0}, {}, 1e-4));
  EXPECT_TRUE(repeats({}, {30.0}, 0.0));  // alone, in no simple ratio to 100 rad/s
  EXPECT_FALSE(repeats({}, {30.0}, 1e-4));
  EXPECT_FALSE(repeats({2.0}, {30.0}, 0.0));
  EXPECT_FALSE(repeats({}, {10.0, 10.0 * sqrt2}, 0.0));
  EXPECT_TRUE(repeats({}, {150.0 / pi}, 1e-4));  // 300 rad/s
  EXPECT_EQ(scene_of({0.5, 3.0}, {}).contacts.repeats_after(), 2);
  EXPECT_EQ(scene_of({0.5, 1.0 / 3.0}, {}).contacts.repeats_after(), 6);
  EXPECT_EQ(scene_of({}, {30.0}).contacts.repeats_after(), 0);
}

TEST(LoadPeriods, AreRefusedWhereTheyAreTooFast) {
  Structure structure;
  structure.forces = {{.name = "hum", .size = 1.0, .frequency = 3000.0}};
  const Excitation load{.order = 0.0, .frequency = 3000.0, .amplitude = {}, .names = "hum"};
  EXPECT_NEAR(frequency_ratio(structure, load, 60.0), 50.0, rounding * 50.0);
  EXPECT_THROW(frequency_ratio(structure, load, 0.1), NumericalError);
  try {
    frequency_ratio(structure, load, 0.1);
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("\"hum\""), std::string::npos) << error.what();
  }
  const Excitation order{.order = 2.5, .frequency = 0.0, .amplitude = {}};
  EXPECT_EQ(frequency_ratio(structure, order, 60.0), 2.5);
  EXPECT_EQ(frequency_ratio(structure, order, 0.1), 2.5);
}

// Where it is after a billion revolutions, to the last digits: ratio times that, whole turns off.
TEST(LoadPeriods, KeepTheirAngleOverManyRevolutions) {
  constexpr double kept = 1e-12;  // [rad]
  ReducedExcitation o;
  o.ratio = 0.375;
  EXPECT_NEAR(start_angle(o.ratio, 0), 0.0, kept);
  EXPECT_NEAR(start_angle(o.ratio, 1), 0.75 * pi, kept);
  EXPECT_NEAR(start_angle(o.ratio, 3), 0.25 * pi, kept);
  EXPECT_NEAR(start_angle(o.ratio, 1'000'000'003), 0.25 * pi,
              kept);  // a billion is a multiple of 8
  EXPECT_NEAR(o.angle({2.0, 1}), 0.75 * pi + 0.75, kept);
}

}  // namespace whirl::load_periods_test
