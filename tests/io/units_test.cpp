// Quantities with units: every good spelling against its SI value, every bad one its message.

#include "libio/text/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "libio/text/vendor_units.hpp"

namespace whirl::units_test {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 4e-16;  // a few roundings of a double, relative

struct Good {
  const char* text;
  const char* si_unit;
  double value;
};

class GoodQuantity : public testing::TestWithParam<Good> {};

TEST_P(GoodQuantity, HasItsValueInSI) {
  const auto [text, si_unit, value] = GetParam();
  const auto parsed = parse_as(text, si_unit);
  ASSERT_TRUE(parsed) << parsed.problem;
  EXPECT_NEAR(*parsed, value, rounding * std::abs(value)) << text;
}

// pound = 0.45359237 kg, standard gravity 9.80665 m/s^2, inch = 0.0254 m: exact by definition
constexpr double lbf = 0.45359237 * 9.80665;
constexpr double psi = lbf / (0.0254 * 0.0254);

INSTANTIATE_TEST_SUITE_P(
    Units, GoodQuantity,
    testing::Values(
        // those of the manual
        Good{"20 mm", "m", 0.02}, Good{"4 MN/m", "N/m", 4e6},
        Good{"3650 rpm", "rad/s", 3650.0 * pi / 30.0}, Good{"0.018 Pa.s", "Pa.s", 0.018},
        Good{"5e3 N.s/m", "N.s/m", 5e3}, Good{"30 deg", "rad", pi / 6.0},
        Good{"1 kg.mm", "kg.m", 1e-3}, Good{"2.333e10 N/m^1.5", "N/m^1.5", 2.333e10},
        Good{"9.81 m/s^2", "m/s^2", 9.81}, Good{"7800 kg/m^3", "kg/m^3", 7800.0},
        Good{"81.2 GPa", "Pa", 81.2e9}, Good{"0 N.m/rad", "N.m/rad", 0.0},
        Good{"138.4 rad/s", "rad/s", 138.4}, Good{"1 mm/s", "m/s", 1e-3},
        // lengths
        Good{"3 m", "m", 3.0}, Good{"7 cm", "m", 0.07}, Good{"2 km", "m", 2e3},
        Good{"30 um", "m", 30e-6}, Good{"30 µm", "m", 30e-6}, Good{"30 μm", "m", 30e-6},
        Good{"8 nm", "m", 8e-9}, Good{"2 mil", "m", 50.8e-6}, Good{"2 thou", "m", 50.8e-6},
        Good{"3 in", "m", 0.0762}, Good{"2 ft", "m", 0.6096},
        // masses, times, forces
        Good{"5 g", "kg", 5e-3}, Good{"5 kg", "kg", 5.0}, Good{"5 mg", "kg", 5e-6},
        Good{"5 t", "kg", 5e3}, Good{"2 lb", "kg", 0.90718474}, Good{"2 lbm", "kg", 0.90718474},
        Good{"16 oz", "kg", 0.45359237}, Good{"1 slug", "kg", lbf / 0.3048}, Good{"4 s", "s", 4.0},
        Good{"4 ms", "s", 4e-3}, Good{"4 us", "s", 4e-6}, Good{"4 min", "s", 240.0},
        Good{"2 h", "s", 7200.0}, Good{"6 N", "N", 6.0}, Good{"6 kN", "N", 6e3},
        Good{"6 MN", "N", 6e6}, Good{"6 mN", "N", 6e-3}, Good{"6 lbf", "N", 6.0 * lbf},
        // pressures and viscosities
        Good{"3 Pa", "Pa", 3.0}, Good{"3 kPa", "Pa", 3e3}, Good{"3 MPa", "Pa", 3e6},
        Good{"3 bar", "Pa", 3e5}, Good{"10 psi", "Pa", 10.0 * psi},
        Good{"1 hp", "W", 745.69987158227022}, Good{"30000 ksi", "Pa", 3e7 * psi},
        Good{"18 cP", "Pa.s", 0.018}, Good{"3 P", "Pa.s", 0.3}, Good{"18 mPa.s", "Pa.s", 0.018},
        Good{"2e-6 reyn", "Pa.s", 2e-6 * psi}, Good{"2 ureyn", "Pa.s", 2e-6 * psi},
        // speeds and angles
        Good{"3.65 krpm", "rad/s", 3650.0 * pi / 30.0}, Good{"50 Hz", "rad/s", 100.0 * pi},
        Good{"2 kHz", "rad/s", 4000.0 * pi}, Good{"50 rev/s", "rad/s", 100.0 * pi},
        Good{"3000 rev/min", "rad/s", 100.0 * pi}, Good{"180 deg/s", "rad/s", pi},
        Good{"0.5 rev", "rad", pi}, Good{"3 mrad", "rad", 3e-3}, Good{"30°", "rad", pi / 6.0},
        Good{"100 rpm/s", "rad/s^2", 100.0 * pi / 30.0},
        // ways to write products, quotients and powers
        Good{"4e6N/m", "N/m", 4e6}, Good{"4 N / mm", "N/m", 4e3}, Good{"2 N·m", "N.m", 2.0},
        Good{"2 N*m", "N.m", 2.0}, Good{"2 N m", "N.m", 2.0}, Good{"1 kg*mm", "kg.m", 1e-3},
        Good{"1 kg mm", "kg.m", 1e-3}, Good{"1 kg  . mm", "kg.m", 1e-3},
        Good{"720 g.mm", "kg.m", 7.2e-4}, Good{"2 oz.in", "kg.m", 0.0283495231250 * 2 * 0.0254},
        Good{"7.8 g/cm^3", "kg/m^3", 7800.0}, Good{"7800 kg/m3", "kg/m^3", 7800.0},
        Good{"7800 kg/m³", "kg/m^3", 7800.0}, Good{"5 kg.m²", "kg.m^2", 5.0},
        Good{"5 kg.m**2", "kg.m^2", 5.0}, Good{"7.8 g/cm**3", "kg/m^3", 7800.0},
        Good{"5 s**-1", "1/s", 5.0}, Good{"3 N**1*m**2", "N.m^2", 3.0},
        Good{"5 kg.m^+2", "kg.m^2", 5.0}, Good{"5 kg.m^2.0", "kg.m^2", 5.0},
        Good{"7800 kg.m^-3", "kg/m^3", 7800.0}, Good{"9.81 m/s/s", "m/s^2", 9.81},
        Good{"2 m^2.kg", "kg.m^2", 2.0}, Good{"4 N/mm^1.5", "N/m^1.5", 4.0 / std::pow(1e-3, 1.5)},
        Good{"1000 lbf/in", "N/m", 1000.0 * lbf / 0.0254}, Good{"1 N.s/mm", "N.s/m", 1e3},
        Good{"5 1/s", "1/s", 5.0}, Good{"5 /s", "1/s", 5.0}, Good{"5/s", "1/s", 5.0},
        Good{"5 s^-1", "1/s", 5.0}, Good{"0.05 s/m", "s/m", 0.05}, Good{"3 N.m^2", "N.m^2", 3.0},
        Good{"3 kg/m", "kg/m", 3.0}, Good{"300 K", "K", 300.0},
        // numbers
        Good{"12", "m", 12.0}, Good{"12", "", 12.0}, Good{" 12 ", "rad/s", 12.0},
        Good{"-5 mm", "m", -5e-3}, Good{"+5 mm", "m", 5e-3}, Good{"−5 mm", "m", -5e-3},
        Good{".5 mm", "m", 5e-4}, Good{"5. mm", "m", 5e-3}, Good{"5.mm", "m", 5e-3},
        Good{"1E3 mm", "m", 1.0}, Good{"2e-3m", "m", 2e-3}, Good{"\t2 m\t", "m", 2.0},
        Good{"20\u00a0mm", "m", 0.02}, Good{"0 mm", "m", 0.0}, Good{"3 mm/m", "", 3e-3}));

TEST(Units, DecimalPrefixesDoNotRound) {
  // 9 * 0.001 is not the double next to 0.009, 9 / 1000 is
  for (int i = 1; i <= 1000; ++i) {
    EXPECT_EQ(*parse_as(std::to_string(i) + " mm", "m"), i / 1e3);
    EXPECT_EQ(*parse_as(std::to_string(i) + " um", "m"), i / 1e6);
    EXPECT_EQ(*parse_as(std::to_string(i) + " g", "kg"), i / 1e3);
  }
}

struct Bad {
  const char* text;
  const char* si_unit;
  const char* problem;
};

void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.text << " as " << bad.si_unit;
}

class BadQuantity : public testing::TestWithParam<Bad> {};

TEST_P(BadQuantity, IsExplained) {
  const auto [text, si_unit, problem] = GetParam();
  const auto parsed = parse_as(text, si_unit);
  ASSERT_FALSE(parsed) << *parsed;
  EXPECT_EQ(parsed.problem, problem);
}

INSTANTIATE_TEST_SUITE_P(
    Units, BadQuantity,
    testing::Values(
        // wrong dimensions
        Bad{"4 MN/mm^2", "N/m", R"(found "4 MN/mm^2", expected a stiffness (N/m))"},
        Bad{"4 MN/m", "N.s/m", R"(found "4 MN/m", expected a damping (N.s/m))"},
        Bad{"5 kg", "m", R"(found "5 kg", expected a length (m))"},
        Bad{"5 m", "", R"(found "5 m", expected a number without unit)"},
        Bad{"5 m", "kg^2.m", R"(found "5 m", expected a value in kg^2.m)"},
        Bad{"5 m", "kg.m", R"(found "5 m", expected an unbalance (kg.m))"},
        // angle counts
        Bad{"5 1/s", "rad/s", R"(found "5 1/s", expected a speed (rad/s))"},
        Bad{"50 Hz", "1/s", R"(found "50 Hz", expected a rate (1/s))"},
        Bad{"3 rad", "", R"(found "3 rad", expected a number without unit)"},
        Bad{"3 m/m", "rad", R"(found "3 m/m", expected an angle (rad))"},
        Bad{"3 N/rad", "N", R"(found "3 N/rad", expected a force (N))"},
        Bad{"3 N.m.rad", "N.m", R"(found "3 N.m.rad", expected a torque or moment (N.m))"},
        Bad{"3 N.m.s", "N.m/rad", R"(found "3 N.m.s", expected a tilt stiffness (N.m/rad))"},
        // typing errors
        Bad{"3 mmm", "m", R"(unknown unit "mmm" in "3 mmm", did you mean "mm"?)"},
        Bad{"3 RPM", "rad/s", R"(unknown unit "RPM" in "3 RPM", did you mean "rpm"?)"},
        Bad{"3 KN", "N", R"(unknown unit "KN" in "3 KN", did you mean "kN"?)"},
        Bad{"3 Nm", "N.m", R"(unknown unit "Nm" in "3 Nm", did you mean "N.m"?)"},
        Bad{"3 Pas", "Pa.s", R"(unknown unit "Pas" in "3 Pas", did you mean "Pa.s"?)"},
        Bad{"3 inch", "m", R"(unknown unit "inch" in "3 inch", did you mean "in"?)"},
        Bad{"3 mN/foo", "N/m", R"(unknown unit "foo" in "3 mN/foo", expected a stiffness (N/m))"},
        Bad{"3 MM", "m", R"(unknown unit "MM" in "3 MM", did you mean "mm"?)"},
        Bad{"3 km/h/", "m/s", R"(cannot read the unit in "3 km/h/", expected a velocity (m/s))"},
        Bad{"3 N..m", "N.m",
            R"(cannot read the unit in "3 N..m", expected a torque or moment (N.m))"},
        Bad{"3 (m)", "m", R"_(cannot read the unit in "3 (m)", expected a length (m))_"},
        Bad{"1,5 mm", "m",
            R"(found a comma in "1,5 mm", decimals follow a point, expected a length (m))"},
        Bad{"12 000 mm", "m", R"(cannot read the unit in "12 000 mm", expected a length (m))"},
        Bad{"3 m^", "m",
            R"(the exponent of "m" in "3 m^" is not a multiple of 0.5, expected a length (m))"},
        Bad{"3 m^1.3", "m",
            R"(the exponent of "m" in "3 m^1.3" is not a multiple of 0.5, expected a length (m))"},
        Bad{"3 m^99", "m",
            R"(the exponent of "m" in "3 m^99" is not a multiple of 0.5, expected a length (m))"},
        // no numbers
        Bad{"lots", "m", R"("lots" is not a number, expected a length (m))"},
        Bad{"", "m", R"("" is not a number, expected a length (m))"},
        Bad{"   ", "m", R"("   " is not a number, expected a length (m))"},
        Bad{"mm", "m", R"("mm" is not a number, expected a length (m))"},
        Bad{"- 5 mm", "m", R"("- 5 mm" is not a number, expected a length (m))"},
        Bad{"+-5 mm", "m", R"("+-5 mm" is not a number, expected a length (m))"},
        Bad{"--5 mm", "m", R"("--5 mm" is not a number, expected a length (m))"},
        Bad{".", "m", R"("." is not a number, expected a length (m))"},
        Bad{"-.mm", "m", R"("-.mm" is not a number, expected a length (m))"},
        Bad{"nan", "m", R"("nan" is not a number, expected a length (m))"},
        Bad{"-nan mm", "m", R"("-nan mm" is not a number, expected a length (m))"},
        Bad{"inf", "m", R"("inf" is not a number, expected a length (m))"},
        Bad{"-infinity", "m", R"("-infinity" is not a number, expected a length (m))"},
        Bad{"1e999", "m", R"("1e999" is beyond the range of numbers, expected a length (m))"},
        Bad{"1e308 km", "m", R"("1e308 km" is beyond the range of numbers, expected a length (m))"},
        Bad{"0x10", "m", R"(unknown unit "x" in "0x10", expected a length (m))"}));

TEST(Units, AngleMayBeLeftOutOfTorsionalUnitsOnly) {
  EXPECT_EQ(parse_as("5 N.m", "N.m/rad").value, 5.0);
  EXPECT_EQ(parse_as("5 N.m/rad", "N.m").value, 5.0);
  EXPECT_EQ(parse_as("5 N.m.s", "N.m.s/rad").value, 5.0);
  EXPECT_EQ(parse_as("5 N.m.s/rad", "N.m.s").value, 5.0);
  // where an angle is written, its size counts: 1 N.m/deg = 180 / pi N.m/rad
  EXPECT_NEAR(*parse_as("1 N.m/deg", "N.m/rad"), 180.0 / pi, 1e-13);
  EXPECT_FALSE(parse_as("5 kg.m^2/rad", "kg.m^2"));
  EXPECT_FALSE(parse_as("5 N/m", "N.m/rad"));
}

TEST(Units, BareNumbersHaveNoUnit) {
  const auto bare = parse_quantity("12");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->value, 12.0);
  EXPECT_EQ(bare->unit, "");
  EXPECT_EQ(bare->dimension, Dimension{});
  EXPECT_EQ(parse_quantity("12 m/m")->unit, "m/m");
  EXPECT_FALSE(parse_as("12 m/m", "m"));
}

TEST(Units, DimensionsOfFieldTables) {
  EXPECT_EQ(dimension_of(""), Dimension{});
  EXPECT_EQ(dimension_of("N/m^1.5"), (Dimension{{2, -1, -4, 0, 0}}));
  EXPECT_EQ(dimension_of("rad/s"), (Dimension{{0, 0, -2, 0, 2}}));
  EXPECT_EQ(dimension_of("N.m/rad"), (Dimension{{2, 4, -4, 0, -2}}));
  EXPECT_EQ(dimension_of("K"), (Dimension{{0, 0, 0, 2, 0}}));
  EXPECT_EQ(dimension_of("Pa.s"), dimension_of("kg/m/s"));
  EXPECT_THROW(dimension_of("mm"), std::invalid_argument);
  EXPECT_THROW(dimension_of("rpm"), std::invalid_argument);
  EXPECT_THROW(dimension_of("furlong"), std::invalid_argument);
}

TEST(Units, QuantitiesHaveNames) {
  for (const auto& [unit, name] :
       std::initializer_list<std::pair<const char*, const char*>>{{"m", "length"},
                                                                  {"kg", "mass"},
                                                                  {"N/m", "stiffness"},
                                                                  {"N.s/m", "damping"},
                                                                  {"kg/m^3", "density"},
                                                                  {"Pa", "pressure or modulus"},
                                                                  {"rad/s", "speed"},
                                                                  {"rad", "angle"},
                                                                  {"N", "force"},
                                                                  {"N.m", "torque or moment"},
                                                                  {"N.m/rad", "tilt stiffness"},
                                                                  {"N.m.s/rad", "tilt damping"},
                                                                  {"kg.m^2", "moment of inertia"},
                                                                  {"kg.m", "unbalance"},
                                                                  {"m/s^2", "acceleration"},
                                                                  {"s", "time"},
                                                                  {"Pa.s", "viscosity"},
                                                                  {"m/s", "velocity"},
                                                                  {"N.m^2", "bending stiffness"},
                                                                  {"kg/m", "line density"},
                                                                  {"N/m^1.5", "Hertz stiffness"},
                                                                  {"kg^2.m", ""}}) {
    EXPECT_EQ(quantity_name(dimension_of(unit)), name);
  }
  EXPECT_EQ(expected_quantity("rad"), "an angle (rad)");
  EXPECT_EQ(expected_quantity("N/m^1.5"), "a Hertz stiffness (N/m^1.5)");
}

TEST(Units, MessagesQuoteLongTextsInPart) {
  EXPECT_EQ(in_quotes("a\nb"), "\"a b\"");
  EXPECT_EQ(in_quotes(std::string(60, 'x')), '"' + std::string(60, 'x') + '"');
  EXPECT_EQ(in_quotes(std::string(61, 'x')), '"' + std::string(60, 'x') + "...\"");
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "µm"), '"' + std::string(59, 'x') + "...\"");
  EXPECT_EQ(in_quotes(std::string(100, '\x80')), "\"...\"");
}

TEST(Units, HugeTextsAreRefusedWithShortMessages) {
  const std::size_t size = 1'000'000;
  for (const std::string& text :
       {std::string(size, 'x'), std::string(size, ' '), "1 " + std::string(size, 'm'),
        "1 m" + std::string(size, '/'), "1 m^" + std::string(size, '9'), std::string(size, '9'),
        "1e" + std::string(size, '9')}) {
    const auto parsed = parse_as(text, "m");
    ASSERT_FALSE(parsed);
    EXPECT_LT(parsed.problem.size(), 300u);
  }
  std::string factors = "1 m";
  for (int i = 0; i < 100'000; ++i) factors += ".km^12";
  EXPECT_FALSE(parse_as(factors, "m"));
  EXPECT_EQ(*parse_as("1." + std::string(size, '0') + " m", "m"), 1.0);
}

TEST(Units, GarbageIsNeitherCrashNorInfinity) {
  std::mt19937 random(20240501);
  const std::string_view pieces[] = {"1",  "9", "-", "+", ".",  "e",   "E",  "nan", "inf",  " ",
                                     "mm", "N", "/", "^", "*",  "µ",   "²",  "·",   "\xff", "\xc2",
                                     "Pa", "s", "0", ":", "kg", "rpm", "°C", "(",   "^-",   "^1.5"};
  std::uniform_int_distribution<std::size_t> piece(0, std::size(pieces) - 1);
  std::uniform_int_distribution<int> byte(0, 255), length(0, 12);
  int good = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string text = i % 4 == 0 ? "3 " : "";
    for (int n = length(random); n > 0; --n) {
      if (i % 3 == 0) {
        text += static_cast<char>(byte(random));
      } else {
        text += pieces[piece(random)];
      }
    }
    const auto parsed = parse_quantity(text);
    if (parsed) {
      ++good;
      EXPECT_TRUE(std::isfinite(parsed->value)) << text;
    } else {
      EXPECT_FALSE(parsed.problem.empty()) << text;
    }
  }
  EXPECT_GT(good, 1000);  // the search reaches good texts too
}

// Units as vendors write them are no units of model files, but what they may mean is told.
TEST(Units, OfVendorsAreRecognized) {
  EXPECT_EQ(vendor_hint("5e5 lb/in", "N/m"), "; did you mean \"5e5 lbf/in\"?");
  EXPECT_EQ(vendor_hint("500 lb-s/in", "N.s/m"), "; did you mean \"500 lbf.s/in\"?");
  EXPECT_EQ(vendor_hint("5 lb", "kg"), "");
  EXPECT_EQ(vendor_hint("5 furlong", "m"), "");
  EXPECT_EQ(vendor_hint("lb/in", "N/m"), "");
}

}  // namespace whirl::units_test
