#include "libio/text/shown_units.hpp"

#include <gtest/gtest.h>

#include "libio/text/format.hpp"

namespace whirl::shown_units_test {

/// Shows other units for one test.
class ShownUnitsIn : public testing::Test {
 protected:
  void TearDown() override { show_in({}); }
  static void show(std::string_view list, std::string_view model = "") {
    const auto units = ShownUnits::named(list, model);
    ASSERT_TRUE(units) << units.problem;
    show_in(*units);
  }
};

TEST_F(ShownUnitsIn, AreThoseOfSiAtFirst) {
  EXPECT_TRUE(shown_units().is_si());
  EXPECT_EQ(shown_value(376.99111843077515, "rpm", ".1f"), "3600.0 rpm");
  EXPECT_EQ(shown_heading("largest", "um"), "largest [um]");
  EXPECT_EQ(shown_number(2.54e-6, "um", ".3f"), "2.540");
}

// Definitions: 1 in = 25.4 mm, 1 lb = 0.45359237 kg, 1 lbf = 4.4482216152605 N.
TEST_F(ShownUnitsIn, OfTheUsAreThoseOfTheirDefinitions) {
  show("us");
  EXPECT_EQ(format_length(25.4e-6), "1 mil");
  EXPECT_EQ(format_length(0.508), "20 in");
  EXPECT_EQ(format_length(0.0), "0 mil");
  EXPECT_EQ(format_engineering(0.45359237, "kg"), "1 lb");
  EXPECT_EQ(format_engineering(4.4482216152605e3, "N"), "1000 lbf");
  EXPECT_EQ(format_engineering(4.4482216152605 / 0.0254, "N/m"), "1 lbf/in");
  EXPECT_EQ(format_engineering(4.4482216152605 / (0.0254 * 0.0254), "Pa"), "1 psi");
  EXPECT_EQ(format_engineering(0.45359237 * 0.0254 * 0.0254, "kg.m^2"), "1 lb.in^2");
  EXPECT_EQ(format_engineering(0.45359237 / 16.0 * 0.0254, "kg.m"), "1 oz.in");
  EXPECT_EQ(shown_heading("largest", "um"), "largest [mil]");
  EXPECT_EQ(shown_number(25.4e-6, "um", ".3f"), "1.0000");
  EXPECT_EQ(shown_heading("z", "mm"), "z [in]");
  EXPECT_EQ(shown_value(0.1, "rpm", ".3f"), "0.955 rpm");
  EXPECT_EQ(format_engineering(2.0, "1/s"), "2 1/s");
}

TEST_F(ShownUnitsIn, MayBeChosenOneByOne) {
  show("us,rad/s,kN");
  EXPECT_EQ(shown_value(100.0, "rpm", ".1f"), "100.00 rad/s");
  EXPECT_EQ(format_speed(100.0), "100 rad/s");
  EXPECT_EQ(format_engineering(250.0, "N"), "0.25 kN");
  EXPECT_EQ(format_length(25.4e-6), "1 mil");
  show("Hz");
  EXPECT_EQ(format_speed(2.0 * 3.14159265358979323846), "1 Hz");
  EXPECT_EQ(format_length(25.4e-6), "25.4 um");
}

TEST_F(ShownUnitsIn, OfCgsAreCentimetersAndDyn) {
  show("cgs");
  EXPECT_EQ(format_length(0.25), "25 cm");
  EXPECT_EQ(format_engineering(1e-5, "N"), "1 dyn");
  EXPECT_EQ(format_engineering(2.0, "kg"), "2000 g");
}

TEST_F(ShownUnitsIn, MayBeNoneOfAModelWithoutDimensions) {
  show("none");
  EXPECT_EQ(format_length(2.0), "2");
  EXPECT_EQ(format_speed(0.25), "0.25");
  EXPECT_EQ(shown_heading("speed", "rpm"), "speed");
  EXPECT_EQ(shown_value(0.25, "rpm", ".2f"), "0.25");
}

TEST_F(ShownUnitsIn, OfAFileAreThoseItIsWrittenIn) {
  show("file", "length = \"20 in\"\nk = \"4e5 lbf/in\"\nd = \"25 mm\"\n");
  EXPECT_EQ(format_length(0.508), "20 in");
  show("file", "length = \"500 mm\"\nk = \"4 MN/m\"\nclearance = \"2 mil\"\n");
  EXPECT_EQ(format_length(0.5), "500 mm");
}

TEST_F(ShownUnitsIn, ThatAreNoneAreSaid) {
  EXPECT_NE(ShownUnits::named("imperial", "").problem.find("\"imperial\" is none of these"),
            std::string::npos);
  EXPECT_FALSE(ShownUnits::named("us,7", ""));
}

// A unit that is read back where a text with it is a value of the command line.
TEST_F(ShownUnitsIn, AreReadBack) {
  show("us");
  for (const char* si : {"m", "N", "N/m", "N.s/m", "kg", "kg.m", "kg.m^2", "Pa", "N.m", "m/s"}) {
    const double value = 12.5;
    const auto back = parse_as(format_engineering(value, si, 10), si);
    ASSERT_TRUE(back) << si << ": " << back.problem;
    EXPECT_NEAR(*back, value, 1e-8 * value) << si;
  }
}

}  // namespace whirl::shown_units_test
