// Values as bytes and back: every bit, and nothing that is not there.

#include "libbase/structs/travel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "libbase/numerics/linalg.hpp"
#include "tests/support/travel.hpp"

namespace whirl::travel_test {

enum class Color : unsigned char { red, green };

struct Sample {
  double number = 0.0;
  Color color = Color::red;
  std::optional<Vec> some;
  std::vector<std::string> texts;
};

template <class Bytes>
void travel(Bytes& bytes, Is<Sample> auto& sample) {
  auto& [number, color, some, texts] = sample;
  bytes(number, color, some, texts);
}

using test::there_and_back;

// A NaN keeps its payload, a zero its sign, and the smallest number is not flushed.
TEST(Travel, KeepsEveryBitOfANumber) {
  const std::vector<double> numbers{std::nan("123"), -0.0,
                                    std::numeric_limits<double>::denorm_min(),
                                    -std::numeric_limits<double>::infinity(), 1.0 / 3.0};
  const std::vector<double> back = there_and_back(numbers);
  ASSERT_EQ(back.size(), numbers.size());
  EXPECT_EQ(std::memcmp(back.data(), numbers.data(), numbers.size() * sizeof(double)), 0);
}

TEST(Travel, KeepsShapesTextsAndWhatIsMissing) {
  Mat matrix(2, 3);
  matrix << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(there_and_back(matrix), matrix);
  EXPECT_EQ(there_and_back(Mat(0, 3)).cols(), 3);
  EXPECT_EQ(there_and_back(std::vector<Sample>(3)).size(), 3u);
  const Sample sample{.number = 2.5,
                      .color = Color::green,
                      .some = Vec::LinSpaced(4, 0, 1),
                      .texts = {"", std::string("a\0b", 3)}};
  const Sample back = there_and_back(sample);
  EXPECT_EQ(back.number, 2.5);
  EXPECT_EQ(back.color, Color::green);
  EXPECT_EQ(back.some, sample.some);
  EXPECT_EQ(back.texts, sample.texts);
  EXPECT_FALSE(there_and_back(Sample{}).some);
  EXPECT_EQ(there_and_back(Failure("why")), Failure("why"));
  const Problem problem{{"a.toml", 3, 7}, "body.mass", "is negative"};
  const Problem same = there_and_back(problem);
  EXPECT_EQ(same.where, problem.where);
  EXPECT_EQ(same.key, problem.key);
  EXPECT_EQ(same.message, problem.message);
}

// Bytes that end too early are refused wherever they end.
TEST(Travel, RefusesShortBytes) {
  const std::string bytes = packed(
      Sample{.number = 1, .color = Color::red, .some = Vec::LinSpaced(3, 0, 1), .texts = {"text"}});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Unpacked from(std::string_view(bytes).substr(0, size));
    Sample sample;
    EXPECT_THROW(from(sample), NumericalError) << size;
  }
}

}  // namespace whirl::travel_test
