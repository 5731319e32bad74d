// What every contact law must obey, run over the list of laws, and the laws by themselves.

#include "libcontact/laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <set>
#include <string>
#include <type_traits>

namespace whirl::laws_test {

constexpr double rounding = 1e-14;  // relative, of a few operations

/// Turns a list of alternatives into the parameters of a typed test.
template <class Variant>
struct Every;
template <class... Laws>
struct Every<std::variant<Laws...>> {
  using Types = ::testing::Types<Laws...>;
};

/// Sets every number of a law, the required ones or all, to the same positive value.
template <class Law>
Law filled(double value, bool optional_too) {
  Law law;
  std::apply(
      [&](const auto&... field) {
        const auto set = [&](const auto& f) {
          if constexpr (std::is_same_v<std::decay_t<decltype(law.*(f.member))>, double>) {
            if (f.is_required || optional_too) law.*(f.member) = value;
          }
        };
        (set(field), ...);
      },
      Law::fields());
  return law;
}

template <class Law>
struct EveryLaw : ::testing::Test {
  Law plain = filled<Law>(1e6, false);  // only what a model must say
  Law full = filled<Law>(1e6, true);    // everything a model may say
};
TYPED_TEST_SUITE(EveryLaw, Every<AnyContactLaw<>>::Types);

TYPED_TEST(EveryLaw, PushesHarderTheDeeper) {
  for (const TypeParam& law : {this->plain, this->full}) {
    for (double d = 1e-7; d < 1e-2; d *= 2.0) {
      EXPECT_GT(law.normal(2.0 * d, 0.0), law.normal(d, 0.0)) << d;
      EXPECT_GT(law.normal(d, 0.0), 0.0) << d;
    }
  }
}

// The engine takes release for the moment of parting only where the law says that they coincide,
// and it relies on the force vanishing with the depth if the rate is zero.
TYPED_TEST(EveryLaw, IsZeroAtZeroDepthAtEveryRateIfAndOnlyIfItSaysSo) {
  for (const TypeParam& law : {this->plain, this->full}) {
    EXPECT_EQ(law.normal(0.0, 0.0), 0.0);
    bool is_zero = true;
    for (const double rate : {-3.0, -1e-3, 1e-3, 3.0}) {
      is_zero = is_zero && law.normal(0.0, rate) == 0.0;
    }
    EXPECT_EQ(law.is_continuous(), is_zero);
  }
}

// Dissipation: moving in it pushes at least as hard as at rest, moving out at most.
TYPED_TEST(EveryLaw, DoesNotFeedEnergyIn) {
  for (const TypeParam& law : {this->plain, this->full}) {
    for (double d = 1e-6; d < 1e-3; d *= 10.0) {
      EXPECT_GE(law.normal(d, +0.1), law.normal(d, 0.0));
      EXPECT_LE(law.normal(d, -0.1), law.normal(d, 0.0));
    }
  }
}

// Trial steps of an integrator end a little outside.
TYPED_TEST(EveryLaw, GoesOnALittleBeyondTheSurface) {
  for (const TypeParam& law : {this->plain, this->full}) {
    const double just_outside = law.normal(-1e-9, 0.0);
    EXPECT_TRUE(std::isfinite(just_outside));
    EXPECT_LE(just_outside, 0.0);
  }
}

// "Written once, for any number type": with d = 1e-4 + i h the imaginary part is h dN/dd.
TYPED_TEST(EveryLaw, TakesOtherNumbersThanReals) {
  constexpr double h = 1e-30, difference = 1e-8;
  constexpr double truncation = 1e-6;  // relative, of a central difference of 1e-4 of the depth
  for (const TypeParam& law : {this->plain, this->full}) {
    const double d = 1e-4, rate = 0.02;
    const std::complex<double> N =
        law.normal(std::complex<double>(d, h), std::complex<double>(rate));
    const double slope =
        (law.normal(d + difference, rate) - law.normal(d - difference, rate)) / (2.0 * difference);
    EXPECT_NEAR(N.real(), law.normal(d, rate), rounding * law.normal(d, rate));
    EXPECT_NEAR(N.imag() / h, slope, truncation * slope);
  }
}

TYPED_TEST(EveryLaw, HasAReadableTableOfFields) {
  EXPECT_FALSE(TypeParam::name.empty());
  std::set<std::string_view> names;
  std::apply(
      [&](const auto&... field) {
        const auto check = [&](const auto& f) {
          EXPECT_TRUE(names.insert(f.name).second) << f.name << " stands twice";
          EXPECT_FALSE(f.meaning.empty()) << f.name;
          EXPECT_EQ(f.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
                    std::string_view::npos)
              << f.name;
          using Member = std::decay_t<decltype(TypeParam().*(f.member))>;
          if (f.range != Range::any && std::is_same_v<Member, double>) {
            EXPECT_FALSE(f.unit.empty()) << f.name;  // a number of a law has a dimension
          }
        };
        (check(field), ...);
      },
      TypeParam::fields());
  EXPECT_FALSE(names.empty());
}

TEST(AnyContactLaw, NamesItsMembersApart) {
  std::set<std::string_view> names;
  const auto insert = [&]<class... Laws>(const std::variant<Laws...>*) {
    (names.insert(Laws::name), ...);
  };
  const AnyContactLaw<> any;
  insert(&any);
  EXPECT_EQ(names.size(), std::variant_size_v<AnyContactLaw<>>);
}

// N = k d + c d'
TEST(Radial, IsASpringWithADamper) {
  const Radial<> law{.k = 2e6, .c = 300.0};
  EXPECT_NEAR(law.normal(1e-3, 0.5), 2000.0 + 150.0, rounding * 2150.0);
  EXPECT_NEAR(law.normal(1e-3, -8.0), 2000.0 - 2400.0,
              rounding * 2400.0);  // the engine cuts it off
  EXPECT_FALSE(law.is_continuous());
  EXPECT_TRUE(Radial<>{.k = 2e6}.is_continuous());
}

// N = k d^1.5 (1 + 1.5 alpha d'): without force where the depth or the factor is zero.
TEST(Hertz, IsDampedByAFactorOfItsRate) {
  const Hertz<> law{.k = 4e9, .alpha = 2.0}, plain{.k = 4e9};
  EXPECT_NEAR(law.normal(1e-4, 0.5), 4e3 * 2.5, rounding * 1e4);
  EXPECT_NEAR(law.normal(1e-4, -0.5), 4e3 * -0.5, rounding * 1e4);  // the engine cuts it off
  // of numbers whose products are exact, so that it is zero where they are fused with the sum, too
  const Hertz<> twice{.k = 4e9, .alpha = 4.0 / 3.0};
  EXPECT_EQ(twice.normal(1e-4, -0.5), 0.0);
  EXPECT_TRUE(law.is_continuous());
  EXPECT_EQ(rate_factor(law, 0.5), 2.5);
  EXPECT_EQ(rate_factor(plain, 0.5), std::nullopt);
  EXPECT_EQ(rate_factor(Radial<>{.k = 2e6, .c = 300.0}, 0.5), std::nullopt);
}

// A law is damped if its force changes with the rate.
TYPED_TEST(EveryLaw, IsDampedIfItSaysSo) {
  for (const TypeParam& law : {this->plain, this->full}) {
    EXPECT_EQ(is_damped(law), law.normal(1e-4, 0.1) != law.normal(1e-4, 0.0));
  }
}

TEST(AnyContactLaw, AnswersForTheLawItHolds) {
  const Radial<> law{.k = 2e6, .c = 300.0};
  const AnyContactLaw<> any = law;
  EXPECT_EQ(normal_force(any, 1e-3, 0.5), law.normal(1e-3, 0.5));
  EXPECT_EQ(is_continuous(any), law.is_continuous());
}

}  // namespace whirl::laws_test
