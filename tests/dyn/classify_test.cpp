// Kinds of motion: those of the rotor and stator, and some that are known in closed form.

#include "libdyn/studies/classify.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.hpp"

namespace whirl::classify_test {

using test::RotorStator;

Classification kind_of(const RotorStator& p, const ClassifyOptions& options = {}) {
  const Scene scene = p.scene();
  Classification c = classify(scene.contacts, test::start_of(p.model(), scene), options);
  EXPECT_EQ(c.outcome, Outcome::reached_end) << c.failure;
  return c;
}

// Five impacts a revolution; the multipliers are those of an independent program, to 1e-6 1/s.
TEST(Classify, ProvesAPeriodicMotion) {
  const Classification c = kind_of(test::P1);
  EXPECT_EQ(c.kind, MotionKind::periodic);
  EXPECT_TRUE(c.is_proven);
  EXPECT_EQ(c.period, 1);
  EXPECT_EQ(c.revolutions, 1);
  EXPECT_EQ(c.impacts(), 5.0);
  EXPECT_LT(c.residual, 1e-8);
  const Vec rates = c.exponents / test::P1.scene().contacts.period();
  EXPECT_NEAR(rates(0), -2.944044, 1e-6);
  EXPECT_NEAR(rates(1), -2.944044, 1e-6);
  EXPECT_NEAR(rates(2), -3.473444, 1e-6);
  EXPECT_NEAR(rates(3), -3.473444, 1e-6);
}

// At 138.4 rad/s and 64 MN/m friction makes chaos and order: chaotic at 0 and 0.2, and between them
// periods that halve, each with seven impacts a revolution.
TEST(Classify, TellsChaosFromOrder) {
  const auto at = [](double mu) { return RotorStator{.Omega = 138.4, .kC = 64e6, .mu = mu}; };
  for (const double mu : {0.0, 0.2}) {
    const Classification c = kind_of(at(mu));
    EXPECT_TRUE(c.kind == MotionKind::chaotic || c.kind == MotionKind::hyperchaotic) << mu;
    EXPECT_FALSE(c.is_proven);
    EXPECT_EQ(c.period, 0);
    EXPECT_GT(c.exponents(0), 0.3);
    EXPECT_GT(c.resolution, 1e-3);
    EXPECT_EQ(c.revolutions, 1000);
  }
  for (const auto& [mu, period] : {std::pair{0.107, 8}, {0.11, 4}, {0.12, 2}, {0.15, 1}}) {
    const Classification c = kind_of(at(mu), {.discard = 2000});
    EXPECT_EQ(c.kind, MotionKind::periodic) << mu;
    EXPECT_TRUE(c.is_proven) << mu;
    EXPECT_EQ(c.period, period) << mu;
    EXPECT_EQ(c.impacts(), 7.0 * period) << mu;
  }
}

// Chaos that is known well enough is averaged no longer; order is, to the end. Contacts are
// measured over all revolutions all the same.
TEST(Classify, AveragesChaosUntilItsExponentIsKnown) {
  const auto at = [](double mu) { return RotorStator{.Omega = 138.4, .kC = 64e6, .mu = mu}; };
  const Classification whole = kind_of(at(0.2));
  const Classification c = kind_of(at(0.2), {.most_exponents = 2, .resolution = 0.2});
  EXPECT_EQ(c.kind, whole.kind);
  ASSERT_EQ(c.exponents.size(), 2);
  EXPECT_LE(c.resolution, 0.2);
  EXPECT_GT(c.resolution, whole.resolution);
  EXPECT_NEAR(c.exponents(0), whole.exponents(0), 0.2);
  EXPECT_EQ(c.revolutions, 1000);
  EXPECT_NEAR(c.impacts(), whole.impacts(), 0.05 * whole.impacts());

  const test::MassInRing torus{.Omega = 100.0, .k = 1.7e4, .U = 1e-5, .clearance = 1e-2};
  const Scene scene = torus.scene();
  const auto start = test::state_of({1e-3, 0.0}, {0.0, 0.1});
  const ClassifyOptions options{.revolutions = 300};
  ClassifyOptions rough = options;
  rough.resolution = 0.2;
  const Classification found = classify(scene.contacts, start, rough);
  EXPECT_EQ(found.kind, MotionKind::quasi_periodic);
  EXPECT_EQ(found.exponents, classify(scene.contacts, start, options).exponents);
}

// Of a proven orbit, too, no more exponents are told than asked for.
TEST(Classify, TellsSoManyExponents) {
  const Classification all = kind_of(test::P1), c = kind_of(test::P1, {.most_exponents = 3});
  EXPECT_TRUE(c.is_proven);
  EXPECT_EQ(c.exponents, all.exponents.head(3));
}

// In the lanes of a batch, among others, a motion becomes what it becomes alone, bit by bit.
TEST(Classify, IsTheSameAloneAndTogether) {
  std::vector<Scene> scenes;
  std::vector<MotionState> starts;
  for (int i = 0; i < 12; ++i) {
    const RotorStator p{.Omega = 131.0 + i, .kC = 64e6, .mu = 0.02 * i};
    scenes.push_back(p.scene());
    starts.push_back(test::start_of(p.model(), scenes.back()));
  }
  const ClassifyOptions options{.discard = 150, .revolutions = 40, .sections = 8};
  std::vector<ClassifyCandidate> together;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    together.push_back({.system = &scenes[i].contacts});
    together.back().found.end = starts[i];
  }
  settle(together, options);
  average(together, options);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Classification alone = classify(scenes[i].contacts, starts[i], options);
    const Classification& c = together[i].found;
    EXPECT_EQ(c.kind, alone.kind) << i;
    EXPECT_EQ(c.period, alone.period) << i;
    EXPECT_EQ(c.exponents, alone.exponents) << i;
    EXPECT_EQ(c.end.y, alone.end.y) << i;
    EXPECT_EQ(c.sections, alone.sections) << i;
    EXPECT_EQ(c.contacts[0].duty, alone.contacts[0].duty) << i;
    EXPECT_EQ(c.contacts[0].max_normal, alone.contacts[0].max_normal) << i;
  }
}

// A rotor that whirls without damping beside its unbalance has two frequencies.
TEST(Classify, FindsTwoFrequencies) {
  const test::MassInRing p{.Omega = 100.0, .k = 1.7e4, .U = 1e-5, .clearance = 1e-2};
  const Scene scene = p.scene();
  const Classification c =
      classify(scene.contacts, test::state_of({1e-3, 0.0}, {0.0, 0.1}), {.revolutions = 300});
  EXPECT_EQ(c.kind, MotionKind::quasi_periodic);
  EXPECT_LT(c.exponents.cwiseAbs().maxCoeff(), c.resolution);
}

// Without unbalance it comes to rest where its weight hangs; with it, it goes around once a turn.
TEST(Classify, KnowsRestFromMotion) {
  test::MassInRing p{.Omega = 100.0, .k = 1e4, .c = 20.0, .clearance = 1e-2, .gravity = 9.81};
  const Scene still = p.scene();
  const MotionState start = test::state_of({1e-3, 0.0}, {0.0, 0.1});
  const Classification rest = classify(still.contacts, start, {});
  EXPECT_EQ(rest.kind, MotionKind::equilibrium);
  EXPECT_NEAR(rest.end.y(1), -9.81 / 1e4, 1e-12);
  // x'' + 20 x' + 1e4 x = 0: all exponents are -10 1/s
  EXPECT_LT((rest.exponents / still.contacts.period() + Vec::Constant(4, 10.0)).norm(), 1e-6);
  p.U = 1e-5;
  const Scene whirling = p.scene();
  const Classification around = classify(whirling.contacts, start, {});
  EXPECT_EQ(around.kind, MotionKind::periodic);
  EXPECT_EQ(around.period, 1);
}

// A free motion whose transient takes 2000 revolutions to fall to a third is known at once: its
// multipliers are those of  x'' + c x' + k x = 0,  and where it ends is
// X = U Omega^2 / (k - m Omega^2 + i c Omega).
TEST(Classify, SettlesAFreeMotionByItsKnownDecay) {
  const test::MassInRing p{.Omega = 130.0, .k = 1e4, .c = 0.02, .U = 1e-6, .clearance = 1e-2};
  const Scene scene = p.scene();
  const MotionState start = test::state_of({5e-3, 0.0}, {0.0, 0.3});
  for (const long discard : {0L, 500L}) {
    const Classification c = classify(scene.contacts, start, {.discard = discard});
    EXPECT_EQ(c.kind, MotionKind::periodic);
    EXPECT_TRUE(c.is_proven);
    EXPECT_TRUE(c.is_free);
    EXPECT_EQ(c.period, 1);
    EXPECT_EQ(c.transient, 0);
    const Vec rates = c.exponents / scene.contacts.period();
    EXPECT_LT((rates - Vec::Constant(4, -0.5 * p.c)).cwiseAbs().maxCoeff(), 1e-10);
    const Complex X = p.U * p.Omega * p.Omega / Complex(p.k - p.Omega * p.Omega, p.c * p.Omega);
    EXPECT_NEAR(c.end.y(0), X.real(), 1e-12);
    EXPECT_NEAR(c.end.y(1), X.imag(), 1e-12);
  }
}

// The bouncing motion of the two-disk rotor has two frequencies once it has settled, at 0.8 % a
// revolution. Before, it is said when that will be, and so it is.
TEST(Classify, SaysWhatWouldSettleAMotion) {
  const test::TwoDiskRub p{
      .k = 8e6,
      .mu = 0.0,
      .start = {{.mode = 1, .amplitude = 4e-3}, {.mode = 2, .amplitude = 3e-3}}};
  const Scene scene = p.scene();
  const MotionState start = test::start_of(p.model(), scene);
  const Classification early =
      classify(scene.contacts, start, {.discard = 50, .revolutions = 100, .exponents = 100});
  EXPECT_EQ(early.kind, MotionKind::not_settled);
  EXPECT_GT(early.drift.change, 0.02);
  ASSERT_GT(early.settles_after, 150);
  const Classification later =
      classify(scene.contacts, start, {.discard = early.settles_after, .revolutions = 200});
  EXPECT_EQ(later.kind, MotionKind::quasi_periodic);
  EXPECT_LT(later.drift.change, 0.02);
  EXPECT_EQ(later.settles_after, 0);
}

// A mass that hangs just where its ring begins is an oscillator with two stiffnesses and no scale:
// its motions grow with the unbalance. With that of a hundred-thousandth of the clearance it
// repeats after two revolutions, between sections that far apart, which is its period nevertheless.
TEST(Classify, KeepsTheLongerPeriodOfATinyMotion) {
  const test::MassInRing p{
      .Omega = 267.0, .k = 1e4, .c = 4.0, .U = 1e-9, .kC = 3e4, .clearance = 1e-3, .gravity = 10.0};
  const Scene scene = p.scene();
  const Classification c =
      classify(scene.contacts, test::state_of({0.0, -1e-3 - 1e-9}, {0.0, 0.0}), {.sections = 2});
  EXPECT_EQ(c.kind, MotionKind::periodic);
  EXPECT_TRUE(c.is_proven);
  EXPECT_EQ(c.period, 2);
  ASSERT_EQ(c.sections.size(), 8u);
  const Eigen::Map<const Mat> sections(c.sections.data(), 4, 2);
  const double apart = distance(scene.contacts, sections.col(0), sections.col(1));
  EXPECT_GT(apart, 3e-6);
  EXPECT_LT(apart, 9e-5);
}

// What cannot be integrated is said, with what was found so far.
TEST(Classify, StopsWhenAskedTo) {
  const RotorStator p{.Omega = 138.4, .kC = 64e6, .mu = 0.2};
  const Scene scene = p.scene();
  const Classification c = classify(scene.contacts, test::start_of(p.model(), scene),
                                    {.watch = [](long done) { return done < 700; }});
  EXPECT_EQ(c.outcome, Outcome::stopped_by_observer);
  EXPECT_GT(c.revolutions, 190);
  EXPECT_LT(c.revolutions, 210);
}

}  // namespace whirl::classify_test
