// Kinds of motion in files: by their words, and in files without words by their order.

#include "libio/results/motion_codes.hpp"

#include <gtest/gtest.h>

#include "tests/io/result_folder.hpp"

namespace whirl::motion_codes_test {

class MotionCodesOf : public test::InResultFolder {
 protected:
  MotionCodes file(const std::string& words) const {
    const auto place = folder / "kinds.h5";
    ResultWriter writer(place, Replaces::anything);
    writer.dataset("/map/motion", std::vector<int>{0, 1}, {"", "kind", {""}});
    if (!words.empty()) writer.attribute("/map/motion", words_attribute, words);
    writer.commit();
    return {ResultReader(place), "/map/motion"};
  }
};

// The numbers that were in files before there were words in them.
TEST_F(MotionCodesOf, FilesWithoutWordsAreTheOldOnes) {
  const MotionCodes codes = file("");
  EXPECT_EQ(codes.kind(0), MotionKind::equilibrium);
  EXPECT_EQ(codes.kind(1), MotionKind::periodic);
  EXPECT_EQ(codes.kind(2), MotionKind::quasi_periodic);
  EXPECT_EQ(codes.kind(3), MotionKind::chaotic);
  EXPECT_EQ(codes.kind(4), MotionKind::hyperchaotic);
  EXPECT_EQ(codes.kind(-1), std::nullopt);
  EXPECT_EQ(codes.kind(99), std::nullopt);
}

TEST_F(MotionCodesOf, FilesWithWordsMeanTheseInTheirOrder) {
  const MotionCodes codes = file("chaotic,of another kind,not settled");
  EXPECT_EQ(codes.kind(0), MotionKind::chaotic);
  EXPECT_EQ(codes.kind(1), std::nullopt);
  EXPECT_EQ(codes.kind(2), MotionKind::not_settled);
  EXPECT_EQ(codes.kind(3), std::nullopt);
  EXPECT_EQ(file(code_words<MotionKind>()).kind(5), MotionKind::not_settled);
}

TEST(MotionWords, AreThoseOfTheList) {
  EXPECT_EQ(
      code_legend<MotionKind>(),
      "0 equilibrium, 1 periodic, 2 quasi-periodic, 3 chaotic, 4 hyperchaotic, 5 not settled");
}

}  // namespace whirl::motion_codes_test
