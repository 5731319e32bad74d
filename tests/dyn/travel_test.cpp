// What of studies goes between processes: all members come back as they were.

#include "libdyn/studies/travel.hpp"

#include <gtest/gtest.h>

#include "libdyn/studies/walk_stretch.hpp"
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

const PeriodicOrbit orbit{.period = 2,
                          .revolution = 0.5,
                          .states = {Vec::Random(4), Vec::Random(4)},
                          .tangents = {Mat::Random(4, 4)},
                          .residual = 1e-12,
                          .residuals = {1.0, 1e-12},
                          .multipliers = CVec::Random(4),
                          .contacts = {{"ring", 0.1, 2.0, 0.3, 4.0, 5.0, 6.0, 7.0}},
                          .failure = "none"};

TEST(Travel, OrbitsComeBackAsTheyWere) {
  const PeriodicOrbit back = there_and_back(orbit);
  EXPECT_EQ(back.period, orbit.period);
  EXPECT_EQ(back.revolution, orbit.revolution);
  EXPECT_EQ(back.states, orbit.states);
  EXPECT_EQ(back.tangents, orbit.tangents);
  EXPECT_EQ(back.residual, orbit.residual);
  EXPECT_EQ(back.residuals, orbit.residuals);
  EXPECT_EQ(back.multipliers, orbit.multipliers);
  EXPECT_EQ(back.contacts.at(0).touch_time, 7.0);
  EXPECT_EQ(back.failure, orbit.failure);

  AutonomousOrbit cycle{.state = Vec::Random(4), .period = 0.25, .residual = 1e-11};
  cycle.residuals = {3.0, 1e-11};
  cycle.multipliers = CVec::Random(3);
  cycle.contacts = orbit.contacts;
  const auto none = there_and_back(std::optional<Bouncing>());
  EXPECT_FALSE(none);
  const Bouncing bounces = there_and_back(Bouncing{500.0, 2.5, cycle, {3, 1}});
  EXPECT_EQ(bounces.speed, 500.0);
  EXPECT_EQ(bounces.turns, 2.5);
  EXPECT_EQ(bounces.lines, (std::array{3, 1}));
  EXPECT_EQ(bounces.cycle.state, cycle.state);
  EXPECT_EQ(bounces.cycle.period, cycle.period);
  EXPECT_EQ(bounces.cycle.residual, cycle.residual);
  EXPECT_EQ(bounces.cycle.residuals, cycle.residuals);
  EXPECT_EQ(bounces.cycle.multipliers, cycle.multipliers);
  EXPECT_EQ(bounces.cycle.contacts.at(0).name, "ring");
}

TEST(Travel, BranchesComeBackAsTheyWere) {
  const BranchPoint point{.value = 0.13,
                          .z = Vec::Random(5),
                          .tangent = Vec::Random(5),
                          .step = 0.01,
                          .multipliers = CVec::Random(4),
                          .residual = 1e-12,
                          .contacts = orbit.contacts};
  const Bifurcation bifurcation{.kind = BifurcationKind::grazing,
                                .at = point,
                                .after = 7,
                                .contact = "ring",
                                .change = -1.0,
                                .multiplier = {0.5, 0.25}};
  const BegunWalk walk{.is_curve = true,
                       .branch = {.period = 2,
                                  .points = {point, {}},
                                  .bifurcations = {bifurcation},
                                  .end = BranchEnd{EndKind::no_orbit, "no more", "why"}},
                       .direction = -1.0,
                       .harmonics = 9,
                       .kind = BifurcationKind::fold,
                       .contact = "seal",
                       .by_parameter = Vec::Random(4)};
  const BegunWalk back = there_and_back(walk);
  EXPECT_TRUE(back.is_curve);
  EXPECT_EQ(back.direction, -1.0);
  EXPECT_EQ(back.harmonics, 9);
  EXPECT_EQ(back.kind, BifurcationKind::fold);
  EXPECT_EQ(back.contact, "seal");
  EXPECT_EQ(back.by_parameter, walk.by_parameter);
  EXPECT_EQ(back.branch.period, 2);
  ASSERT_EQ(back.branch.points.size(), 2u);
  const BranchPoint& p = back.branch.points[0];
  EXPECT_EQ(p.value, point.value);
  EXPECT_EQ(p.z, point.z);
  EXPECT_EQ(p.tangent, point.tangent);
  EXPECT_EQ(p.step, point.step);
  EXPECT_EQ(p.multipliers, point.multipliers);
  EXPECT_EQ(p.residual, point.residual);
  EXPECT_EQ(p.contacts.at(0).duty, 0.1);
  ASSERT_EQ(back.branch.bifurcations.size(), 1u);
  const Bifurcation& b = back.branch.bifurcations[0];
  EXPECT_EQ(b.kind, BifurcationKind::grazing);
  EXPECT_EQ(b.at.z, point.z);
  EXPECT_EQ(b.after, 7u);
  EXPECT_EQ(b.contact, "ring");
  EXPECT_EQ(b.change, -1.0);
  EXPECT_EQ(b.multiplier, bifurcation.multiplier);
  ASSERT_TRUE(back.branch.end);
  EXPECT_EQ(back.branch.end->kind, EndKind::no_orbit);
  EXPECT_EQ(back.branch.end->text, "no more");
  EXPECT_EQ(back.branch.end->reason, "why");

  const WalkNews news{.branch = walk.branch,
                      .measures = {{{0.1, 0.2}, 3.0, {4.0, 5.0}, Mat::Random(4, 2)}},
                      .starts = {Vec::Random(4)},
                      .by_parameter = Vec::Random(4)};
  const WalkNews news_back = there_and_back(news);
  EXPECT_EQ(news_back.branch.points.size(), 2u);
  EXPECT_EQ(news_back.measures.at(0).radii, news.measures[0].radii);
  EXPECT_EQ(news_back.measures[0].work, 3.0);
  EXPECT_EQ(news_back.measures[0].probe_peak_to_peak, news.measures[0].probe_peak_to_peak);
  EXPECT_EQ(news_back.measures[0].sections, news.measures[0].sections);
  EXPECT_EQ(news_back.starts, news.starts);
  EXPECT_EQ(news_back.by_parameter, news.by_parameter);
}

}  // namespace whirl::dyn_travel_test
