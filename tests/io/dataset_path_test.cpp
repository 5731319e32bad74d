// Datasets by the members that they hold.

#include "libio/results/dataset_path.hpp"

#include <gtest/gtest.h>

#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libfe/analyses/campbell.hpp"

namespace whirl::dataset_path_test {

TEST(DatasetPath, IsThatOfAMemberOrOfAMemberOfItsRows) {
  EXPECT_EQ(dataset_of<MotionRecord>(&MotionRecord::coordinates), "/trajectory/coordinates");
  EXPECT_EQ(dataset_of<MotionRecord>(&MotionRecord::normal), "/trajectory/normal_force");
  EXPECT_EQ(dataset_of<Campbell>(&CampbellBranch::frequency), "/campbell/frequency");
}

TEST(DatasetPath, OfRowsBeginsWithTheirPrefix) {
  EXPECT_EQ(dataset_of<UnbalanceStudy>(&StationPeak::below), "/unbalance/peak_below");
  EXPECT_EQ(dataset_of<UnbalanceStudy>(&UnbalanceStudy::peaks), "/unbalance/peak_speed");
}

TEST(DatasetPath, OfAFunctionIsItsColumn) {
  EXPECT_EQ(dataset_of<ClassificationResult>(&ClassificationResult::exponents),
            "/classify/exponent");
}

TEST(DatasetPath, IsEmptyOfWhatNoFileHas) {
  EXPECT_EQ(dataset_of<UnbalanceStudy>(&UnbalanceStudy::unbounded), "");
  EXPECT_EQ(dataset_of<UnbalanceStudy>(&UnbalanceStudy::failure), "");
}

}  // namespace whirl::dataset_path_test
