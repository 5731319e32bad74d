// What of studies goes between processes: all members come back as they were.

#include "libdyn/studies/travel.hpp"

#include <gtest/gtest.h>

#include "tests/support/travel.hpp"

namespace whirl::dyn_travel_test {

using test::there_and_back;

const ContactDoing doing{Regime::intermittent, 0.25, 3.0, 0.125, 10.0, 20.0};
const ClassifiedMotion motion{.kind = MotionKind::chaotic,
                              .period = 3,
                              .is_proven = true,
                              .transient = 96,
                              .revolutions = 1000,
                              .resolution = 0.01,
                              .section_dimension = 1.5,
                              .exponents = {0.1, -0.2},
                              .contacts = {doing},
                              .settles_after = 700,
                              .failure = "why"};

void expect_same(const ClassifiedMotion& a, const ClassifiedMotion& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.is_proven, b.is_proven);
  EXPECT_EQ(a.transient, b.transient);
  EXPECT_EQ(a.revolutions, b.revolutions);
  EXPECT_EQ(a.resolution, b.resolution);
  EXPECT_EQ(a.section_dimension, b.section_dimension);
  EXPECT_EQ(a.exponents, b.exponents);
  EXPECT_EQ(a.settles_after, b.settles_after);
  EXPECT_EQ(a.failure, b.failure);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const ContactDoing &x = a.contacts[i], &y = b.contacts[i];
    EXPECT_EQ(x.regime, y.regime);
    EXPECT_EQ(x.duty, y.duty);
    EXPECT_EQ(x.impacts_per_rev, y.impacts_per_rev);
    EXPECT_EQ(x.sticking, y.sticking);
    EXPECT_EQ(x.max_normal, y.max_normal);
    EXPECT_EQ(x.max_tangential, y.max_tangential);
  }
}

TEST(Travel, RowsComeBackAsTheyWere) {
  expect_same(there_and_back(motion), motion);
  EXPECT_FALSE(there_and_back(ClassifiedMotion{}).kind);

  const FullState state{Vec::LinSpaced(4, 0, 1), Vec::LinSpaced(4, 2, 3)};
  const BasinsPoint start{motion, state, {1.0, 2.0, 3.0}};
  const BasinsPoint start_back = there_and_back(start);
  expect_same(start_back.motion, motion);
  EXPECT_EQ(start_back.start.displacement, state.displacement);
  EXPECT_EQ(start_back.start.velocity, state.velocity);
  EXPECT_EQ(start_back.sections, start.sections);

  SweepPoint point{.motion = motion};
  static_cast<FullState&>(point.end) = state;
  point.end.revolution = 17;
  point.portrait = {Mat::Random(2, 3), Mat::Random(2, 3), Vec::Random(2), Mat::Random(2, 5),
                    Mat::Random(1, 36)};
  const SweepPoint point_back = there_and_back(point);
  expect_same(point_back.motion, motion);
  EXPECT_EQ(point_back.end.displacement, state.displacement);
  EXPECT_EQ(point_back.end.velocity, state.velocity);
  EXPECT_EQ(point_back.end.revolution, 17);
  EXPECT_EQ(point_back.portrait.poincare_x, point.portrait.poincare_x);
  EXPECT_EQ(point_back.portrait.poincare_y, point.portrait.poincare_y);
  EXPECT_EQ(point_back.portrait.max_radius, point.portrait.max_radius);
  EXPECT_EQ(point_back.portrait.spectrum, point.portrait.spectrum);
  EXPECT_EQ(point_back.portrait.contact_angle, point.portrait.contact_angle);
}

// Of a motion that has settled, all but its scene.
TEST(Travel, SettledMotionsComeBackAsTheyWere) {
  StudyMotion settled{.failure = "no start"};
  Classification& c = settled.subject.found;
  c = {.kind = MotionKind::quasi_periodic, .period = 2, .exponents = Vec::Random(4)};
  c.is_proven = c.is_free = true;
  c.residual = 1e-12;
  c.zero = 2e-3;
  c.resolution = 3e-3;
  c.drift = {0.1, 0.2, 0.3, 0.4};
  c.settles_after = 5;
  c.section_dimension = 1.25;
  c.revolutions = 6;
  c.transient = 7;
  c.contacts = {{"ring", 0.1, 2.0, 0.3, 4.0, 5.0, 6.0, 7.0}};
  c.sections = {8.0, 9.0};
  c.end = {10, 0.5, Vec::Random(4), {{Touch::sticking, -1.0}}};
  c.outcome = Outcome::not_finite;
  c.failure = "beyond";
  const StudyMotion back = there_and_back(settled);
  const Classification& d = back.subject.found;
  EXPECT_EQ(back.failure, settled.failure);
  EXPECT_EQ(back.scene, nullptr);
  EXPECT_EQ(d.kind, c.kind);
  EXPECT_EQ(d.period, c.period);
  EXPECT_EQ(d.exponents, c.exponents);
  EXPECT_TRUE(d.is_proven && d.is_free);
  EXPECT_EQ(d.residual, c.residual);
  EXPECT_EQ(d.zero, c.zero);
  EXPECT_EQ(d.resolution, c.resolution);
  EXPECT_EQ(d.drift.change, 0.1);
  EXPECT_EQ(d.drift.rate, 0.2);
  EXPECT_EQ(d.drift.left, 0.3);
  EXPECT_EQ(d.drift.spread, 0.4);
  EXPECT_EQ(d.settles_after, c.settles_after);
  EXPECT_EQ(d.section_dimension, c.section_dimension);
  EXPECT_EQ(d.revolutions, c.revolutions);
  EXPECT_EQ(d.transient, c.transient);
  ASSERT_EQ(d.contacts.size(), 1u);
  EXPECT_EQ(d.contacts[0].name, "ring");
  EXPECT_EQ(d.contacts[0].duty, 0.1);
  EXPECT_EQ(d.contacts[0].touch_time, 7.0);
  EXPECT_EQ(d.sections, c.sections);
  EXPECT_EQ(d.end.revolution, 10);
  EXPECT_EQ(d.end.phase, 0.5);
  EXPECT_EQ(d.end.y, c.end.y);
  EXPECT_EQ(d.end.contacts, c.end.contacts);
  EXPECT_EQ(d.outcome, c.outcome);
  EXPECT_EQ(d.failure, c.failure);
}

}  // namespace whirl::dyn_travel_test
