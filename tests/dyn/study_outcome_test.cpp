// What is said of all points of a study together.

#include "libdyn/studies/study_outcome.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "libdyn/studies/row_travel.hpp"

namespace whirl::study_outcome_test {

ClassifiedMotion unsettled(long settles_after) {
  return {.kind = MotionKind::not_settled, .settles_after = settles_after};
}

StudyOutcome outcome_of(const std::vector<std::optional<ClassifiedMotion>>& motions) {
  PointRows<ClassifiedMotion> points(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions[i]) points.set(i, *motions[i]);
  }
  return study_outcome(points, 1, [](std::size_t i) { return "point " + std::to_string(i); });
}

TEST(StudyOutcome, CountsWhatFailedAndNamesTheFirst) {
  const StudyOutcome o =
      outcome_of({ClassifiedMotion{.kind = MotionKind::periodic},
                  ClassifiedMotion{.failure = "steps too small"}, ClassifiedMotion{}});
  EXPECT_EQ(o.failure, "2 of 3 points, for instance at point 1: steps too small");
  EXPECT_TRUE(o.is_whole());
  EXPECT_FALSE(o.has_failed());
  EXPECT_EQ(o.resumed, 1u);
  EXPECT_TRUE(outcome_of({ClassifiedMotion{}}).has_failed());
}

TEST(StudyOutcome, IsNotWholeWhereAPointIsNotKnown) {
  const StudyOutcome o = outcome_of({ClassifiedMotion{}, std::nullopt});
  EXPECT_EQ(o.done, 1u);
  EXPECT_FALSE(o.is_whole());
  EXPECT_FALSE(o.has_failed());
}

// as many revolutions as the slowest of those that would settle needs
TEST(StudyOutcome, SaysAfterHowLongMotionsWouldSettle) {
  const UnsettledMotions m = outcome_of({unsettled(0), unsettled(700), unsettled(300)}).unsettled;
  EXPECT_EQ(m.motions, 3);
  EXPECT_EQ(m.would_settle, 2);
  EXPECT_EQ(m.settles_after, 700);
  EXPECT_FALSE(outcome_of({unsettled(0)}).unsettled.settles_after.has_value());
}

}  // namespace whirl::study_outcome_test
