// Simulations: what is recorded, when, and what their contacts did.

#include "libdyn/motions/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/motions/touches.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::simulate_test {

using test::MassInRing;
using test::pi;
using test::RotorStator;

// Sample j is the motion at phase 2 pi j / samples: free vibration x = A cos(w t) in closed form.
TEST(Simulate, SamplesAtEqualPhases) {
  constexpr double interpolation = 1e-9;  // of the dense output, per tolerance 1e-10
  const MassInRing p{.Omega = 70.0, .k = 1e4};
  const Scene scene = p.scene();
  const double A = 0.5e-3, w = 100.0;
  const Simulation s = simulate(scene, test::state_of({A, 0.0}, {0.0, 0.0}),
                                {.revolutions = 4, .discard = 3, .samples = 10});
  ASSERT_EQ(s.integration.outcome, Outcome::reached_end);
  const Recording& r = s.recording;
  EXPECT_EQ(r.samples, 10);
  EXPECT_EQ(r.revolutions, 4);
  EXPECT_EQ(r.first_revolution, 3);
  EXPECT_EQ(r.speed(), scene.contacts.Omega());
  ASSERT_EQ(r.eta.cols(), 40);
  for (Eigen::Index j = 0; j < r.eta.cols(); ++j) {
    const double t = r.time(j);
    EXPECT_NEAR(t, (3.0 + static_cast<double>(j) / 10.0) * scene.contacts.period(), 1e-12);
    EXPECT_NEAR(r.angle(j), scene.contacts.phase_rate() * (t - r.time(0)), 1e-9);
    EXPECT_NEAR(r.eta(0, j), A * std::cos(w * t), interpolation * p.clearance);
  }
  EXPECT_EQ(s.end.revolution, 7);
  EXPECT_EQ(s.end.phase, 0.0);
}

// The forces that are recorded are those of the states that are recorded; what does not touch has
// none.
TEST(Simulate, RecordsTheForcesOfItsContacts) {
  const Scene scene = test::P3.scene();  // permanent contact
  const Simulation s = simulate(scene, test::start_of(test::P3.model(), scene),
                                {.revolutions = 3, .discard = 60, .samples = 16});
  const Recording& r = s.recording;
  ASSERT_EQ(r.normal.cols(), r.eta.cols());
  for (Eigen::Index j = 0; j < r.eta.cols(); ++j) {
    const Vec2 u = scene.contacts.contacts()[0].U * r.eta.col(j);
    const double N = test::P3.kC * (u.norm() - test::P3.gap);
    EXPECT_NEAR(r.normal(0, j), N, 1e-9 * N);
    EXPECT_NEAR(std::abs(r.friction(0, j)), test::P3.mu * N, 1e-9 * N);
  }
  const MassInRing quiet{.U = 1e-7};
  const Simulation apart =
      simulate(quiet.scene(), test::state_of({0.0, 0.0}, {0.0, 0.0}), {.revolutions = 3});
  EXPECT_EQ(apart.recording.normal, Mat::Zero(1, 3 * 64));
  EXPECT_EQ(apart.recording.contacts[0].regime(), Regime::none);
}

// Discarding is the same as running before; recording changes nothing.
// Two contacts that touch in turn; the last touch is still there at the end.
TEST(ContactTouches, StandInTheOrderInWhichTheyBegin) {
  Recording r;
  r.contacts.resize(2);
  r.contacts[0].name = "left";
  r.contacts[1].name = "right";
  r.time = Vec::LinSpaced(8, 0.0, 0.7);
  r.normal = Mat::Zero(2, 8);
  r.normal.row(0) << 0, 5, 7, 0, 0, 0, 2, 3;
  r.normal.row(1) << 0, 0, 1, 0, 9, 0, 0, 0;
  const std::vector<ContactTouch> all = touches_of(r);
  ASSERT_EQ(all.size(), 4u);
  const char* names[]{"left", "right", "right", "left"};
  const double begins[]{0.1, 0.2, 0.4, 0.6}, ends[]{0.2, 0.2, 0.4, 0.7}, largest[]{7, 1, 9, 3};
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].contact, names[i]);
    EXPECT_NEAR(all[i].begins, begins[i], 1e-12);
    EXPECT_NEAR(all[i].ends, ends[i], 1e-12);
    EXPECT_EQ(all[i].largest, largest[i]);
  }
  EXPECT_EQ(touches_of(r, 1).front().begins, r.time(6));
}

TEST(Simulate, DiscardsRevolutionsBefore) {
  const Scene scene = test::P1.scene();
  const MotionState start = test::start_of(test::P1.model(), scene);
  const Simulation once = simulate(scene, start, {.revolutions = 4, .discard = 6});
  const Simulation early = simulate(scene, start, {.revolutions = 6, .discard = 0});
  const Simulation late = simulate(scene, early.end, {.revolutions = 4, .discard = 0});
  EXPECT_EQ(once.end.y, late.end.y);
  EXPECT_EQ(once.recording.eta, late.recording.eta);
  EXPECT_EQ(once.recording.first_revolution, late.recording.first_revolution);
  EXPECT_EQ(once.integration.cost.events,
            early.integration.cost.events + late.integration.cost.events);
}

TEST(Simulate, ReportsProgressAndKeepsWhatItHasWhenStopped) {
  const Scene scene = test::P1.scene();
  const MotionState start = test::start_of(test::P1.model(), scene);
  std::vector<long> seen;
  SimulationOptions how{.revolutions = 8, .discard = 2, .samples = 16};
  how.progress = [&](long done) {
    seen.push_back(done);
    return done < 6;
  };
  const Simulation s = simulate(scene, start, how);
  EXPECT_EQ(s.integration.outcome, Outcome::stopped_by_observer);
  EXPECT_EQ(seen, (std::vector<long>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(s.recording.revolutions, 4);  // whole ones, of the six less two
  EXPECT_EQ(s.recording.eta.cols(), 4 * 16);

  how.progress = [](long done) { return done < 1; };  // while still discarding
  const Simulation none = simulate(scene, start, how);
  EXPECT_EQ(none.integration.outcome, Outcome::stopped_by_observer);
  EXPECT_EQ(none.recording.revolutions, 0);
}

// Whether to stop is asked at every step, so that even a revolution without end can be stopped.
TEST(Simulate, StopsWithinARevolution) {
  const Scene scene = test::P1.scene();
  const MotionState start = test::start_of(test::P1.model(), scene);
  for (const long discard : {0L, 2L}) {
    for (const std::string_view name : method_names()) {
      SimulationOptions how{.revolutions = 8, .discard = discard, .samples = 16};
      how.method = method_named(name);
      int asked = 0;
      how.is_stopped = [&] { return ++asked == 3; };
      const Simulation s = simulate(scene, start, how);
      EXPECT_EQ(s.integration.outcome, Outcome::stopped_by_observer) << name;
      EXPECT_EQ(asked, 3) << name;
      EXPECT_EQ(s.end.revolution, 0) << name;
      EXPECT_EQ(s.recording.revolutions, 0) << name;
    }
  }
}

// ---- contact measures ---------------------------------------------------------------------------

// A mass crosses a ring along a diameter: each contact lasts half a period pi / w of the mass on
// the contact's spring, its largest force is v0 w m; 2 gap / v0 pass between contacts. Friction: mu
// of it, as the slip velocity Omega R keeps its sign (the mass is turned aside little).
TEST(ContactMeasures, AreThoseOfABounceInClosedForm) {
  const double v0 = 0.5;
  const MassInRing p{.Omega = 100.0, .k = 0.0, .kC = 1e6};
  const Scene scene = p.scene();
  const double w = std::sqrt(p.kC / p.m), contact = pi / w, crossing = 2.0 * p.clearance / v0;
  const long revolutions = 10;
  const Simulation s = simulate(scene, test::state_of({0.0, 0.0}, {v0, 0.0}),
                                {.revolutions = revolutions, .discard = 0});
  const ContactMeasure& ring = s.recording.contacts.at(0);
  const double t = static_cast<double>(revolutions) * scene.contacts.period();
  const double impacts = std::floor((t - 0.5 * crossing) / (contact + crossing)) + 1.0;
  const double rest = t - 0.5 * crossing - (impacts - 1.0) * (contact + crossing);  // in the last
  EXPECT_EQ(ring.name, "ring");
  EXPECT_EQ(ring.regime(), Regime::intermittent);
  EXPECT_EQ(ring.impacts, impacts);
  EXPECT_NEAR(ring.duty, ((impacts - 1.0) * contact + std::min(rest, contact)) / t, 1e-8);
  EXPECT_NEAR(ring.max_normal, v0 * w * p.m, 1e-4 * v0 * w * p.m);  // parabola through nine places
  EXPECT_EQ(ring.max_tangential, 0.0);
  EXPECT_EQ(ring.sticking, 0.0);
  EXPECT_NEAR(ring.mean_slip, 0.0, 1e-12);  // radius 0, along a diameter
}

// A rotor held against the ring by gravity, at rest but for its spin: N = m g - k_s (gap + depth)
// is the weight that the spring leaves, T = mu N, the slip is Omega R, for ever.
TEST(ContactMeasures, OfPermanentContact) {
  const MassInRing p{
      .Omega = 100.0, .k = 1.0, .c = 400.0, .kC = 1e6, .mu = 0.1, .R = 0.02, .gravity = 9.81};
  const Scene scene = p.scene();
  const Simulation s =
      simulate(scene, test::state_of({0.0, -1e-3}, {0.0, 0.0}), {.revolutions = 5, .discard = 60});
  const ContactMeasure& ring = s.recording.contacts.at(0);
  EXPECT_EQ(ring.regime(), Regime::permanent);
  EXPECT_EQ(ring.duty, 1.0);
  EXPECT_EQ(ring.impacts, 0.0);
  // the foot of the mass rests where N, T, weight and spring balance: N sqrt(1 + mu^2) = m g - ...
  const double weight = p.m * p.gravity - p.k * p.clearance;
  EXPECT_NEAR(ring.max_normal, weight / std::sqrt(1.0 + p.mu * p.mu), 1e-3 * weight);
  EXPECT_NEAR(ring.max_tangential, p.mu * ring.max_normal, 1e-9 * ring.max_normal);
  EXPECT_NEAR(ring.mean_slip, p.Omega * p.R, 1e-6 * p.Omega * p.R);
}

// Rolling: it sticks all the time, and the slip is zero (tests/dyn/two_disk_mac_test.cpp has it for
// a rotor). Here a share of the time: measures of a stretch are those of its parts, weighted.
TEST(ContactMeasures, OfAWholeAreThoseOfItsParts) {
  const RotorStator p = test::P4;
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  test::run(scene, state, 30);
  ContactMeter whole(scene.contacts);
  std::vector<ContactMeasure> parts;
  for (int part = 0; part < 2; ++part) {
    ContactMeter meter(scene.contacts);
    test::run(scene, state, 10, {}, [&](const Step& step) {
      meter.add(step);
      whole.add(step);
      return true;
    });
    parts.push_back(meter.measures()[0]);
  }
  const ContactMeasure sum = whole.measures()[0];
  EXPECT_GT(sum.duty, 0.0);
  EXPECT_LT(sum.duty, 1.0);
  EXPECT_NEAR(sum.duty, 0.5 * (parts[0].duty + parts[1].duty), 1e-12);
  EXPECT_EQ(sum.max_normal, std::max(parts[0].max_normal, parts[1].max_normal));
  EXPECT_NEAR(sum.impacts, parts[0].impacts + parts[1].impacts, 1.0);  // one may begin at the seam
}

}  // namespace whirl::simulate_test
