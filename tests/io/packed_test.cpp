// Structs as numbers, and what is said of numbers that are none.

#include "libio/results/packed.hpp"

#include <gtest/gtest.h>

#include "libio/results/packed_branch.hpp"

namespace whirl::packed_test {

BranchPoint example() {
  BranchPoint p{.value = 0.12, .z = Vec{{1.0, -2.0, 0.5}}, .tangent = Vec{{0.0, 0.6, 0.8}}};
  p.step = 1e-3;
  p.multipliers = CVec{{Complex(0.5, 0.25), Complex(0.5, -0.25)}};
  p.residual = 1e-12;
  p.contacts = {{.duty = 0.25, .impacts = 7.0, .max_normal = 1e3}};
  return p;
}

std::vector<double> numbers_of(const BranchPoint& p) {
  Packer packer;
  pack_point(packer, p);
  return packer.numbers();
}

BranchPoint point_of(const std::vector<double>& numbers) {
  Unpacker unpacker("/branch/walk", numbers);
  BranchPoint p;
  pack_point(unpacker, p);
  unpacker.finish();
  return p;
}

TEST(Packed, APointIsTheSameAgain) {
  const BranchPoint p = example(), q = point_of(numbers_of(p));
  EXPECT_EQ(q.value, p.value);
  EXPECT_EQ(q.z, p.z);
  EXPECT_EQ(q.tangent, p.tangent);
  EXPECT_EQ(q.step, p.step);
  EXPECT_EQ(q.multipliers, p.multipliers);
  EXPECT_EQ(q.residual, p.residual);
  ASSERT_EQ(q.contacts.size(), 1u);
  EXPECT_EQ(q.contacts[0].impacts, 7.0);
  EXPECT_EQ(q.contacts[0].max_normal, 1e3);
}

TEST(Packed, MatricesAndWholeNumbersAreTheSameAgain) {
  const Mat m{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  Packer packer;
  packer(m), packer(Mat()), packer(42), packer(BifurcationKind::grazing);
  Unpacker unpacker("/x", packer.numbers());
  Mat again, none(1, 1);
  long count = 0;
  BifurcationKind kind{};
  unpacker(again), unpacker(none), unpacker(count), unpacker(kind);
  unpacker.finish();
  EXPECT_EQ(again, m);
  EXPECT_EQ(none.size(), 0);
  EXPECT_EQ(count, 42);
  EXPECT_EQ(kind, BifurcationKind::grazing);
}

// Numbers that end early, go on too long or count more than there is are refused, with their
// dataset.
TEST(Packed, DamageIsToldWithItsPlace) {
  const std::vector<double> whole = numbers_of(example());
  const auto problem = [](const std::vector<double>& numbers) -> std::string {
    try {
      point_of(numbers);
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(problem(whole), "none");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::vector<double> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n));
    EXPECT_TRUE(problem(part).starts_with("/branch/walk: ")) << n << problem(part);
  }
  std::vector<double> longer = whole;
  longer.push_back(0.0);
  EXPECT_EQ(problem(longer),
            "/branch/walk: 1 numbers are left behind the last one: it is damaged, or of another "
            "version or study");
  for (const double count : {-1.0, 2.5, 1e18, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<double> other = whole;
    other[1] = count;  // of z
    EXPECT_NE(problem(other).find("expected a whole number up to"), std::string::npos) << count;
  }
}

}  // namespace whirl::packed_test
