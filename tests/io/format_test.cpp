// Quantities for people: prefixes, four digits, and back again.

#include "libio/text/format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "libio/text/units.hpp"

namespace whirl::format_test {

TEST(Format, ChoosesThePrefix) {
  EXPECT_EQ(format_engineering(4e6, "N/m"), "4 MN/m");
  EXPECT_EQ(format_engineering(5e3, "N.s/m"), "5 kN.s/m");
  EXPECT_EQ(format_engineering(211e9, "Pa"), "211 GPa");
  EXPECT_EQ(format_engineering(0.018, "Pa.s"), "18 mPa.s");
  EXPECT_EQ(format_engineering(2.333e10, "N/m^1.5"), "23.33 GN/m^1.5");
  EXPECT_EQ(format_engineering(0.05, "s"), "50 ms");
  EXPECT_EQ(format_engineering(-0.05, "N"), "-50 mN");
  EXPECT_EQ(format_engineering(7800.0, "kg/m^3"), "7800 kg/m^3");
  EXPECT_EQ(format_engineering(9.81, "m/s^2"), "9.81 m/s^2");
  EXPECT_EQ(format_engineering(1e-3, "m/s"), "1 mm/s");
  EXPECT_EQ(format_engineering(5.5, "kg"), "5.5 kg");
  EXPECT_EQ(format_engineering(0.25, "kg"), "250 g");
  EXPECT_EQ(format_engineering(7.2e-4, "kg.m"), "720 g.mm");
  EXPECT_EQ(format_engineering(2.5e-3, "kg.m"), "2.5 kg.mm");
  EXPECT_EQ(format_engineering(1e-4, "m^2"), "0.0001 m^2");
  EXPECT_EQ(format_engineering(0.1, ""), "0.1");
}

TEST(Format, LengthsAndSpeeds) {
  EXPECT_EQ(format_length(0.0005), "500 um");
  EXPECT_EQ(format_length(0.02), "20 mm");
  EXPECT_EQ(format_length(1.2), "1.2 m");
  EXPECT_EQ(format_length(1234.5), "1234 m");
  EXPECT_EQ(format_length(0.0), "0 m");
  EXPECT_EQ(format_speed(3650.0 * std::numbers::pi / 30.0), "3650 rpm");
  EXPECT_EQ(format_speed(12345.0 * std::numbers::pi / 30.0), "12340 rpm");
}

TEST(Format, RoundsBeforeItChooses) {
  EXPECT_EQ(format_engineering(999.94, "N"), "999.9 N");
  EXPECT_EQ(format_engineering(999.96, "N"), "1 kN");
  EXPECT_EQ(format_engineering(0.99999, "m"), "1 m");
}

TEST(Format, ExtremesStayReadable) {
  EXPECT_EQ(format_engineering(std::nan(""), "m"), "nan m");
  EXPECT_EQ(format_engineering(-std::numeric_limits<double>::infinity(), "N"), "-inf N");
  EXPECT_EQ(format_engineering(1e-300, "m"), "1e-291 nm");
  EXPECT_EQ(format_engineering(1e-310, "m^2"), "1e-310 m^2");
  EXPECT_EQ(format_engineering(1e300, "N"), "1e+291 GN");
}

TEST(Format, IsReadBackToFourDigits) {
  for (const char* unit : {"m", "kg", "kg.m", "N/m", "N.m/rad", "rad/s", "Pa", "s", "N/m^1.5"}) {
    for (double value = 1.2345678e-9; value < 1e12; value *= 7.7) {
      const std::string text = format_engineering(value, unit);
      const auto back = parse_as(text, unit);
      ASSERT_TRUE(back) << back.problem;
      EXPECT_NEAR(*back, value, 5.1e-4 * value) << text;
    }
  }
}

}  // namespace whirl::format_test
