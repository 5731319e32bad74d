// Stretches of a recorded motion: by revolutions, by times, the end where nothing is asked for.

#include "libio/results/motion_window.hpp"

#include <gtest/gtest.h>

#include "libbase/error.hpp"

namespace whirl::motion_window_test {

constexpr double period = 0.02;  ///< [s]
constexpr Eigen::Index per_revolution = 16;

/// So many revolutions that were recorded after others.
RecordedMotion recorded(long discarded, long revolutions, bool spins = true) {
  RecordedMotion m{.period = period, .per_revolution = per_revolution, .spins = spins};
  m.time.resize(revolutions * per_revolution);
  for (Eigen::Index j = 0; j < m.time.size(); ++j) {
    m.time(j) = period * (static_cast<double>(discarded) + static_cast<double>(j) / per_revolution);
  }
  return m;
}

TEST(MotionWindow, IsTheEndOfTheMotionWhereNothingIsAskedFor) {
  const MotionSamples s = samples_of({}, recorded(500, 120), 8.0);
  EXPECT_EQ(s.last, 120 * per_revolution - 1);
  EXPECT_EQ(s.first, s.last - 8 * per_revolution);
  EXPECT_EQ(samples_of({}, recorded(0, 4), 8.0).first, 0);  // shorter than usual: all
  EXPECT_EQ(samples_of({.revolutions = 2.0}, recorded(0, 4), 8.0).size(), 2 * per_revolution + 1);
}

TEST(MotionWindow, BeginsAndEndsWithTheRevolutionsThatAreAskedFor) {
  const MotionSamples s =
      samples_of({.from_revolution = 0.0, .revolutions = 20.0}, recorded(0, 120), 8.0);
  EXPECT_EQ(s.first, 0);
  EXPECT_EQ(s.last, 20 * per_revolution);
  EXPECT_EQ(s.text, "revolutions 0 to 20 of 120, 0 to 0.4 s");

  const MotionSamples later = samples_of({.from_revolution = 510.0}, recorded(500, 120), 8.0);
  EXPECT_EQ(later.first, 10 * per_revolution);
  EXPECT_EQ(later.last, 18 * per_revolution);
  EXPECT_EQ(later.text, "revolutions 510 to 518 of 500 to 620, 10.2 to 10.36 s");

  // up to the end, of which the last sample is one short
  const MotionSamples whole =
      samples_of({.from_revolution = 500.0, .revolutions = 120.0}, recorded(500, 120), 8.0);
  EXPECT_EQ(whole.size(), 120 * per_revolution);
  EXPECT_EQ(samples_of({.from_revolution = 618.0}, recorded(500, 120), 8.0).last, whole.last);
}

TEST(MotionWindow, TakesTimes) {
  const MotionSamples s =
      samples_of({.times = {{0.5 * period, 2.0 * period}}}, recorded(0, 4), 8.0);
  EXPECT_EQ(s.first, per_revolution / 2);
  EXPECT_EQ(s.last, 2 * per_revolution);
  EXPECT_EQ(s.text, "revolutions 0.5 to 2 of 4, 0.01 to 0.04 s");
  EXPECT_EQ(samples_of({.times = {{0.0, 0.04}}}, recorded(0, 4, false), 8.0).text, "0 to 0.04 s");
}

TEST(MotionWindow, SaysWhatThereIsWhereSomethingElseIsAskedFor) {
  const RecordedMotion motion = recorded(500, 120);
  for (const MotionWindow& window :
       {MotionWindow{.from_revolution = 0.0}, MotionWindow{.from_revolution = 499.0},
        MotionWindow{.from_revolution = 620.0},
        MotionWindow{.from_revolution = 610.0, .revolutions = 11.0},
        MotionWindow{.times = {{0.0, 10.5}}}, MotionWindow{.times = {{10.0, 12.5}}},
        MotionWindow{.times = {{11.0, 11.0}}}}) {
    try {
      samples_of(window, motion, 8.0);
      ADD_FAILURE() << window.from_revolution.value_or(-1.0);
    } catch (const ModelError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("revolutions 500 to 620, 10 to 12.4 s"), std::string::npos) << text;
    }
  }
}

}  // namespace whirl::motion_window_test
