// What studies say of all their points, and tables of their motions.

#include "libio/texts/study_text.hpp"

#include <gtest/gtest.h>

#include "libio/texts/basins_text.hpp"

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
  result.points.resize(4);
  for (const std::size_t i : {0ul, 1ul, 3ul}) result.points.set(i, settled);
  result.points.set(2, open);
  result.basins = {{.first = 0, .count = 3}};
  const BasinShares shares = basin_shares(result);
  EXPECT_DOUBLE_EQ(shares.attractors.at(0).share, 0.75);
  EXPECT_DOUBLE_EQ(shares.unsettled, 0.25);
  EXPECT_EQ(text_of(shares),
            "  motion       share of starts  period  contacts  impacts per revolution  largest "
            "exponent per revolution  first start\n"
            "  ───────────  ───────────────  ──────  ────────  ──────────────────────  "
            "───────────────────────────────  ───────────\n"
            "  periodic             75.00 %       2         -                       0              "
            "            -0.5000            1\n"
            "  not settled          25.00 %       -         -                       -              "
            "                  -            -\n");
}

}  // namespace whirl::study_text_test
