// What every kind of bearing must obey, run over the list of kinds.

#include "libfe/parts/bearings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace whirl::bearings_test {

constexpr double rounding = 1e-12;  // relative, of interpolation

/// Turns a list of alternatives into the parameters of a typed test.
template <class Variant>
struct Every;
template <class... Kinds>
struct Every<std::variant<Kinds...>> {
  using Types = ::testing::Types<Kinds...>;
};

BearingCoefficients row(double scale) {
  BearingCoefficients c;
  c.K << 4e6 * scale, 1e5, -2e5, 3e6;
  c.C << 5e3, 1e2, 1e2 * scale, 4e3 / scale;
  c.Kt << 2e3, 10.0 * scale, -10.0, 1e3 * scale;
  c.Ct << 3.0 * scale, 0.1, -0.1, 2.0;
  c.M << 4.0 * scale, 0.2, -0.2, 5.0;
  return c;
}

/// A kind in which every field says something.
template <class Kind>
Kind filled() {
  Kind kind;
  const auto set = [&](const auto& field) {
    auto& member = kind.*field.member;
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, double>) {
      member = 1e-2;
    } else if constexpr (std::is_same_v<Member, int>) {
      member = 3;
    } else if constexpr (std::is_same_v<Member, Mat2>) {
      member << 4e6, 1e5, -2e5, 3e6;
    } else if constexpr (std::is_same_v<Member, CoefficientTable>) {
      member = {{100.0, 200.0, 500.0}, {row(1.0), row(2.0), row(0.5)}};
    }
  };
  std::apply([&](const auto&... field) { (set(field), ...); }, Kind::fields());
  return kind;
}

/// All twenty coefficients.
std::vector<double> numbers(const BearingCoefficients& c) {
  std::vector<double> all;
  for (const auto part : BearingCoefficients::parts()) {
    for (const double value : (c.*part).reshaped()) all.push_back(value);
  }
  return all;
}

const std::vector<double> frequencies = {0.0, 1.0, 80.0, 150.0, 199.0, 260.0, 490.0, 700.0, 5000.0};

template <class Kind>
struct EveryBearing : ::testing::Test {
  Kind bearing = filled<Kind>();
};
TYPED_TEST_SUITE(EveryBearing, Every<AnyBearing>::Types);

TYPED_TEST(EveryBearing, HasFiniteCoefficientsAtEverySpeed) {
  for (const double Omega : frequencies) {
    for (const double omega : {-300.0, 0.0, 40.0, 1000.0}) {
      for (const double c : numbers(this->bearing.at(Omega, omega))) {
        EXPECT_TRUE(std::isfinite(c)) << Omega << " " << omega;
      }
    }
  }
}

// Halving a step of the speed, or of the whirl frequency, halves a change that is none at last.
TYPED_TEST(EveryBearing, GoesOnWithoutJumps) {
  constexpr double step = 1e-6;      // [rad/s]
  constexpr double steepest = 1e-2;  // [1/(rad/s)], of a coefficient over the largest of its matrix
  const auto expect_near = [&](const BearingCoefficients& a, const BearingCoefficients& b) {
    for (const auto part : BearingCoefficients::parts()) {
      EXPECT_LE((a.*part - b.*part).cwiseAbs().maxCoeff(),
                2.0 * step * steepest * (a.*part).cwiseAbs().maxCoeff());
    }
  };
  std::vector<double> speeds = frequencies;
  for (const double Omega : this->bearing.speeds()) speeds.push_back(Omega);
  for (const double at : speeds) {
    SCOPED_TRACE(at);
    expect_near(this->bearing.at(at - step, 70.0), this->bearing.at(at + step, 70.0));
    expect_near(this->bearing.at(70.0, at - step), this->bearing.at(70.0, at + step));
  }
}

TYPED_TEST(EveryBearing, DependsOnSpeedAndWhirlAsItSays) {
  bool by_speed = false, by_whirl = false;
  const auto here = numbers(this->bearing.at(0.0, 0.0));
  for (const double at : frequencies) {
    by_speed = by_speed || numbers(this->bearing.at(at, 0.0)) != here;
    by_whirl = by_whirl || numbers(this->bearing.at(0.0, at)) != here;
  }
  EXPECT_EQ(by_speed, this->bearing.depends_on_speed());
  EXPECT_EQ(by_whirl, this->bearing.depends_on_whirl());
}

// The critical speed map takes the softest and the stiffest from these speeds.
TYPED_TEST(EveryBearing, HasNoExtremesBetweenTheSpeedsItWasTold) {
  const auto speeds = this->bearing.speeds();
  if (speeds.empty()) return;
  EXPECT_TRUE(std::is_sorted(speeds.begin(), speeds.end()));
  std::vector<double> least(20, std::numeric_limits<double>::infinity()), largest = least;
  for (double& v : largest) v = -v;
  for (const double Omega : speeds) {
    const auto values = numbers(this->bearing.at(Omega, Omega));
    for (std::size_t i = 0; i < 20; ++i) {
      least[i] = std::min(least[i], values[i]);
      largest[i] = std::max(largest[i], values[i]);
    }
  }
  for (const double Omega : frequencies) {
    const auto values = numbers(this->bearing.at(Omega, Omega));
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_GE(values[i], least[i] - rounding * std::abs(least[i])) << Omega;
      EXPECT_LE(values[i], largest[i] + rounding * std::abs(largest[i])) << Omega;
    }
  }
  EXPECT_EQ(numbers(this->bearing.at(speeds.front() - 50.0, 0.0)),
            numbers(this->bearing.at(speeds.front(), 0.0)));
  EXPECT_EQ(numbers(this->bearing.at(speeds.back() + 50.0, 0.0)),
            numbers(this->bearing.at(speeds.back(), 0.0)));
}

TYPED_TEST(EveryBearing, HasAReadableTableOfFields) {
  EXPECT_FALSE(TypeParam::name.empty());
  std::set<std::string_view> names;
  const auto check = [&](const auto& f) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name << " stands twice";
    EXPECT_FALSE(f.meaning.empty()) << f.name;
    EXPECT_EQ(f.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string_view::npos)
        << f.name;
    using Member = std::decay_t<decltype(TypeParam().*(f.member))>;
    if (std::is_same_v<Member, Mat2>) {
      EXPECT_FALSE(f.unit.empty()) << f.name;
    }
  };
  std::apply([&](const auto&... field) { (check(field), ...); }, TypeParam::fields());
  EXPECT_FALSE(names.empty());
  if (!TypeParam::told_by.empty()) {
    EXPECT_TRUE(names.contains(TypeParam::told_by));
  }
}

TYPED_TEST(EveryBearing, AnswersInTheList) {
  const AnyBearing any = this->bearing;
  for (const double Omega : frequencies) {
    EXPECT_EQ(numbers(coefficients(any, Omega, 70.0)), numbers(this->bearing.at(Omega, 70.0)));
    EXPECT_EQ(numbers(coefficients(any, Omega)), numbers(this->bearing.at(Omega, Omega)));
  }
  EXPECT_EQ(depends_on_speed(any),
            this->bearing.depends_on_speed() || this->bearing.depends_on_whirl());
  EXPECT_EQ(depends_on_whirl(any), this->bearing.depends_on_whirl());
  EXPECT_EQ(told_speeds(any).size(), this->bearing.speeds().size());
  EXPECT_EQ(told_whirls(any).size(), this->bearing.whirls().size());
}

TEST(AnyBearing, NamesItsKindsAndTheirKeysApart) {
  std::set<std::string_view> names, keys;
  const auto insert = [&]<class... Kinds>(const std::variant<Kinds...>*) {
    (names.insert(Kinds::name), ...);
    const auto is_new = [&](std::string_view key) {
      return key.empty() || keys.insert(key).second;
    };
    EXPECT_TRUE((is_new(Kinds::told_by) && ...));
  };
  const AnyBearing any;
  insert(&any);
  EXPECT_EQ(names.size(), std::variant_size_v<AnyBearing>);
}

}  // namespace whirl::bearings_test
