// What studies say of all their points, and tables of their motions.

#include "libio/texts/study_text.hpp"

#include <gtest/gtest.h>

#include "libio/texts/basins_text.hpp"
#include "libio/texts/fit_text.hpp"
#include "libio/texts/sweep_text.hpp"

namespace whirl::study_text_test {

TEST(StudyText, SaysWhatWouldSettleMotions) {
  StudyOutcome o{.done = 4, .points = 4};
  EXPECT_EQ(text_of(o, true), "");
  o.unsettled = {.motions = 1};
  EXPECT_EQ(text_of(o, true),
            "\n  1 motion has not settled; more --revolutions would tell what they become\n");
  o.unsettled = {.motions = 1, .settles_after = 700, .would_settle = 1};
  EXPECT_EQ(text_of(o, true), "\n  1 motion has not settled; --discard 700 would settle it\n");
  o.unsettled = {.motions = 3, .settles_after = 700, .would_settle = 2};
  EXPECT_EQ(text_of(o, true),
            "\n  3 motions have not settled; --discard 700 would settle 2, of others more "
            "--revolutions would tell\n");
}

TEST(StudyText, SaysWhereItGoesOn) {
  const StudyOutcome o{.resumed = 1, .done = 2, .points = 4};
  EXPECT_EQ(text_of(o, true),
            "\n  1 of 4 points were there already\n"
            "\n  stopped with 2 of 4 points; the same line goes on from there\n");
  EXPECT_EQ(text_of(o, false),
            "\n  1 of 4 points were there already\n\n  stopped with 2 of 4 points\n");
}

// motions that have not settled are no attractor, but a share of the starts
TEST(BasinsText, SharesAddUpToAllStarts) {
  BasinsResult result;
  BasinsPoint settled, open;
  settled.motion.kind = MotionKind::periodic;
  settled.motion.period = 2;
  settled.motion.exponents = {-0.5};
  open.motion.kind = MotionKind::not_settled;
  open.motion.contacts = {{.regime = Regime::intermittent, .duty = 0.4}};
  result.points.resize(4);
  for (const std::size_t i : {0ul, 1ul, 3ul}) result.points.set(i, settled);
  result.points.set(2, open);
  result.basins = {{.first = 0, .count = 3}};
  result.attractor = {0, 0, unsettled_start, 0};
  const BasinShares shares = basin_shares(result);
  EXPECT_DOUBLE_EQ(shares.attractors.at(0).share, 0.75);
  ASSERT_EQ(shares.unsettled.size(), 1u);
  EXPECT_DOUBLE_EQ(shares.unsettled[0].share, 0.25);
  EXPECT_EQ(shares.unsettled[0].regimes, std::vector{Regime::intermittent});
  EXPECT_EQ(text_of(shares),
            "  motion       share of starts  period  contacts      impacts per revolution  largest "
            "exponent per revolution  first start\n"
            "  ───────────  ───────────────  ──────  ────────────  ──────────────────────  "
            "───────────────────────────────  ───────────\n"
            "  periodic             75.00 %       2  -                                  0          "
            "                -0.5000            1\n"
            "  not settled          25.00 %       -  intermittent                       -          "
            "                      -            -\n");
}

// A line that a shell takes, whatever names there are.
TEST(FitText, GoesOnWithALineForAShell) {
  MeasuredFit found;
  FittedParameter p;
  p.path = "contact.seal 1.friction";
  p.value = 0.25;
  p.standard_deviation = 0.01;
  found.parameters = {p};
  const std::string text = text_of(found, "my rotor.toml");
  EXPECT_NE(
      text.find("whirl simulate 'my rotor.toml' \\\n    --set 'contact.seal 1.friction=0.25'"),
      std::string::npos)
      << text;
}

// A contact that is apart, touches now and then at two values, always at the third, and is apart
// again.
TEST(SweepText, SaysWhereContactsBeginAndEnd) {
  const std::vector<double> values{1.0, 2.0, 3.0, 4.0, 5.0};
  SweepResult result{.system = {.contacts = {"ring"}}, .start = SweepStart::fresh};
  result.points.resize(values.size());
  const std::vector<Regime> regimes{Regime::none, Regime::intermittent, Regime::permanent,
                                    Regime::permanent, Regime::none};
  for (std::size_t i = 0; i < regimes.size(); ++i) {
    SweepPoint point;
    point.motion.kind = MotionKind::periodic;
    point.motion.period = 1;
    point.motion.exponents = {-0.5};
    point.motion.contacts = {{.regime = regimes[i]}};
    result.points.set(i, point);
  }
  const std::vector<TouchRange> ranges = touch_ranges({result, values});
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].from, 1u);
  EXPECT_EQ(ranges[0].to, 3u);
  EXPECT_TRUE(ranges[0].begins && ranges[0].ends);
  EXPECT_FALSE(ranges[0].is_permanent);
  const ParameterAxis axis{.path = "operation.speed", .unit = "rad/s", .values = values};
  EXPECT_NE(
      text_of(result, axis).find("  contact ring touches from 2 (not at 1) to 4 (no more at 5)\n"),
      std::string::npos)
      << text_of(result, axis);
}

}  // namespace whirl::study_text_test
