// Shafts from tables, as engineers keep them in spreadsheets.

#include "libio/model/shaft_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "libfe/assembly/assemble.hpp"
#include "libio/model/model_doubts.hpp"
#include "tests/io/problems.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace shaft_table_test {

std::vector<ShaftRow> rows(const std::string& text) {
  std::vector<Problem> found;
  const std::vector<ShaftRow> result = parse_shaft_table(text, "shaft.csv", found);
  for (const Problem& p : found) ADD_FAILURE() << describe(p);
  return result;
}

std::string problems_in(const std::string& text) {
  std::vector<Problem> found;
  parse_shaft_table(text, "shaft.csv", found);
  std::string all;
  for (const Problem& p : found) all += describe(p) + "\n";
  return all;
}

TEST(ShaftTable, ReadsEveryColumnInSi) {
  const auto t = rows(
      "length [mm], outer_left [mm], outer_right [mm], inner_left [in], inner_right [in], "
      "material, "
      "layer, elements, carries, rayleigh_mass [1/s], rayleigh_stiffness [us]\n"
      "100, 50, 60, 0, 1, steel, 1, 4, , 3, 2\n"
      ", 80, 90, 2, 2, bronze, 2, , mass, , \n"
      "25.4, 60, 60, 0, 0, steel, 1, , , , \n");
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].line, 2);
  EXPECT_DOUBLE_EQ(t[0].length, 0.1);
  EXPECT_DOUBLE_EQ(t[0].left.outer, 0.05);
  EXPECT_DOUBLE_EQ(t[0].right.outer, 0.06);
  EXPECT_DOUBLE_EQ(t[0].right.inner, 0.0254);
  EXPECT_EQ(t[0].material, "steel");
  EXPECT_EQ(t[0].layer, 1);
  EXPECT_EQ(t[0].elements, 4);
  EXPECT_DOUBLE_EQ(t[0].damping.mass, 3.0);
  EXPECT_DOUBLE_EQ(t[0].damping.stiffness, 2e-6);
  EXPECT_EQ(t[1].layer, 2);
  EXPECT_DOUBLE_EQ(t[1].length, 0.1);  // that of the row on which it lies
  EXPECT_EQ(t[1].carries, Carries::mass);
  EXPECT_FALSE(t[1].has_damping);
  EXPECT_DOUBLE_EQ(t[2].length, 0.0254);
}

TEST(ShaftTable, NamesOfColumnsAreTakenInAnyOrderAndSpelling) {
  const auto t = rows(
      "\xEF\xBB\xBF# station table, drawing 4711\r\n"
      "\"OD left [in]\"; \"OD-right [in]\"; L [in]; Material;;\r\n"
      "2; 3; 10; \"AISI 4340\";;\r\n"
      ";;;;;\r\n");
  ASSERT_EQ(t.size(), 1u);
  EXPECT_DOUBLE_EQ(t[0].length, 0.254);
  EXPECT_DOUBLE_EQ(t[0].right.outer, 0.0762);
  EXPECT_EQ(t[0].left.inner, 0.0);
  EXPECT_EQ(t[0].material, "AISI 4340");
  EXPECT_DOUBLE_EQ(rows("length,od\n1,2 mm\n")[0].right.outer, 0.002);
  EXPECT_DOUBLE_EQ(rows("length;od [mm]\n0,5;22,5\n")[0].right.outer, 0.0225);
  EXPECT_DOUBLE_EQ(rows("length\tod left [mm]\tod right [mm]\n0.5\t20\t30\n")[0].left.outer, 0.02);
}

TEST(ShaftTable, ProblemsNameTheirLines) {
  EXPECT_EQ(problems_in("length,outer_diameter\n1,0.1\n# \nx,0.1\n1,-2\n2\n"),
            "shaft.csv:4:1: length: \"x\" is not a number, expected a length (m)\n"
            "shaft.csv:5:3: outer_diameter: found \"-2\", expected a length (m) of zero or more\n"
            "shaft.csv:6:2: found 1 columns, expected 2 as in the first line\n");
  EXPECT_EQ(problems_in("length,outer_diameter,inner_diameter\n,0.1,\n1,,\n1,0.1,0.1\n"),
            "shaft.csv:2:1: length: missing, expected a length (m)\n"
            "shaft.csv:3:3: outer_diameter: missing, expected an outer diameter (m) at both ends\n"
            "shaft.csv:4:7: inner_diameter: found 100 mm, expected less than the outer diameter of "
            "100 mm\n");
}

// Spreadsheets of stations as engineers keep them: numbers of rows, and their own short names.
TEST(ShaftTable, NamesOfStationTablesAreKnown) {
  const std::string data = "1;10;2;1\n2;5;3;0\n";
  for (const char* names :
       {"Sta. No.;Length [in];O.D. [in];I.D. (in)", "STA;LEN (IN);OD (In);ID (in)",
        "Station;Length (inch);Outer Dia. [in];Bore [in]", "No.;L in;OD in;ID in",
        "#;Length [in];OD [in];ID [in]", "# Sta;Length [in];OD [in];ID [in]",
        "# drawing 4711, in\n#;Length [in];OD [in];ID [in]", "Sta;Length;OD;ID\n;in;in;in",
        "Sta;Length;OD;ID\n-;[in];(in);in"}) {
    SCOPED_TRACE(names);
    const auto t = rows(std::string(names) + "\n" + data);
    ASSERT_EQ(t.size(), 2u);
    EXPECT_DOUBLE_EQ(t[1].length, 5 * 0.0254);
    EXPECT_DOUBLE_EQ(t[0].left.outer, 2 * 0.0254);
    EXPECT_DOUBLE_EQ(t[0].right.inner, 0.0254);
  }
  // a comment that is no line of names stays one
  EXPECT_EQ(rows("# length, od\nlength;od\n1;2\n").size(), 1u);
  EXPECT_EQ(problems_in("# all in mm, od\n1;2\n")
                .find("shaft.csv:2:1: found numbers, expected a "
                      "line with the names of the columns first"),
            0u);
}

// Positions of the ends of segments are the lengths between them; the last one is the end.
TEST(ShaftTable, PositionsBecomeLengths) {
  for (const char* name : {"Position [mm]", "z [mm]", "Axial position (mm)", "Lage [mm]"}) {
    const auto t = rows(std::string(name) + ";od [mm]\n0;40\n100;50\n250;50\n");
    ASSERT_EQ(t.size(), 3u) << name;
    EXPECT_DOUBLE_EQ(t[0].length, 0.1);
    EXPECT_DOUBLE_EQ(t[1].length, 0.15);
    EXPECT_TRUE(t[2].is_end);
  }
  EXPECT_EQ(problems_in("z [mm];od\n0;1\n100;1\n50;1\n"),
            "shaft.csv:4:1: position: positions must ascend from line to line\n");
  EXPECT_EQ(problems_in("Station [mm];od;l\n1;2;3\n").find("shaft.csv:1:1: station: numbers of "),
            0u);
}

// What stands at the left end of a row, in the units and by the names of a station table; the last
// row may be the end of the shaft.
TEST(ShaftTable, StationsHaveMassesAndNamesOfParts) {
  const auto t = rows(
      "Sta. No.,Length (in),OD (in),Added Wt (lb),Ip (lb-in^2),It (lb-in**2),Unbal (oz-in),Brg,"
      "Probe,Component\n"
      "1,4,2,45.0,720,420,,,,Coupling\n"
      "2,4,2,,,,1.5,DE,DE-X/DE-Y,\n"
      "3,,,10,,,,NDE,,\n");
  constexpr double lb = 0.45359237, in = 0.0254;
  ASSERT_EQ(t.size(), 3u);
  const StationCells &first = t[0].at_left, &second = t[1].at_left, &end = t[2].at_left;
  EXPECT_TRUE(first.has_disk);
  EXPECT_EQ(first.name, "Coupling");
  EXPECT_DOUBLE_EQ(first.mass, 45.0 * lb);
  EXPECT_DOUBLE_EQ(first.polar_inertia, 720.0 * lb * in * in);
  EXPECT_DOUBLE_EQ(first.diametral_inertia, 420.0 * lb * in * in);
  EXPECT_FALSE(second.has_disk);
  EXPECT_DOUBLE_EQ(second.unbalance, 1.5 / 16.0 * lb * in);
  ASSERT_EQ(second.named.size(), 3u);
  EXPECT_EQ(second.named[0].kind + " " + second.named[0].name, "bearing DE");
  EXPECT_EQ(second.named[1].name, "DE-X");
  EXPECT_EQ(second.named[2].name, "DE-Y");
  EXPECT_TRUE(t[2].is_end);
  EXPECT_DOUBLE_EQ(end.mass, 10.0 * lb);
  // a row without a length in the middle is none
  EXPECT_EQ(problems_in("length,od\n1,1\n0,1\n1,1\n"),
            "shaft.csv:3:1: length: found 0, expected a length (m) above zero\n");
}

// Columns that nobody knows are told and left, as a weight, which may be that of the segment
// itself; what is nearly a name is a mistake.
TEST(ShaftTable, ColumnsThatAreNotKnownAreTold) {
  std::vector<Problem> wrong, told;
  const auto t = parse_shaft_table("length,od,Weight,No\n1,2,3,1\n", "s.csv", wrong, &told);
  EXPECT_EQ(t.size(), 1u);
  EXPECT_TRUE(wrong.empty());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(describe(told[0]).find("s.csv:1:11: Weight: this column is not known and not read"),
            0u);
}

// Heads in other languages, a line of names that stands once more on the next page, blanks that
// delimit.
TEST(ShaftTable, HeadsOfOtherCountries) {
  for (const char* head : {"Länge [mm];Außendurchmesser [mm];Bohrung [mm]",
                           "Longueur (mm);Diamètre extérieur (mm);"
                           "Alésage (mm)",
                           "Comprimento (mm);Diâmetro externo (mm);Diâmetro interno (mm)"}) {
    const auto t = rows(std::string(head) + "\n100;40,5;10\n" + head + "\n100;50,5;10\n");
    ASSERT_EQ(t.size(), 2u) << head;
    EXPECT_DOUBLE_EQ(t[1].left.outer, 0.0505);
    EXPECT_DOUBLE_EQ(t[1].left.inner, 0.01);
  }
  EXPECT_DOUBLE_EQ(rows("Sta. No. Length (mm) O.D. (mm)\n1 100 40\n2 100 50\n")[1].left.outer,
                   0.05);
}

TEST(ShaftTable, ThousandsAreNotTakenForDecimals) {
  EXPECT_EQ(
      problems_in("length [in];od [in];material\n3;2.75;a\n3;5,250;b\n4;6,500;a\n"),
      "shaft.csv:3:3: outer_diameter: the comma in \"5,250\" may be that of thousands or of "
      "decimals, and other numbers of this table have decimal points; write 5250 or 5.25; and "
      "1 more row\n");
  // numbers of steels are words
  EXPECT_DOUBLE_EQ(rows("length;od;material\n1,5;1,125;1.4301\n")[0].left.outer, 1.125);
}

TEST(ShaftTable, OneCauseIsToldOnceWithItsRows) {
  EXPECT_EQ(problems_in("length,od,material\n1,1,a\n,2,b\n1,1,a\n,2,b\n,2,b\n"),
            "shaft.csv:3:1: length: missing, expected a length (m); or, if this lies on the row "
            "before, a column layer with 2 here; and 2 more rows\n");
  EXPECT_EQ(problems_in("length,od\n1,2 lb\n1,3 lb\n1,x\n"),
            "shaft.csv:2:3: outer_diameter: found \"2 lb\", expected a length (m); and 1 more row\n"
            "shaft.csv:4:3: outer_diameter: \"x\" is not a number, expected a length (m)\n");
}

TEST(ShaftTable, LayersLieOnTheRowBefore) {
  const std::string head = "length,outer_diameter,inner_diameter,layer,elements,carries\n";
  EXPECT_EQ(
      problems_in(head + "1,0.1,0,2,,\n"),
      "shaft.csv:2:9: layer: found 2, expected a row of layer 1 before it, on which it lies\n");
  EXPECT_EQ(
      problems_in(head + "1,0.1,0,1,,\n0.5,0.2,0.1,2,,\n"),
      "shaft.csv:3:1: length: found 500 mm, expected the 1000 mm of line 2, on which the layer "
      "lies\n");
  EXPECT_EQ(
      problems_in(head + "1,0.1,0,1,,\n,0.2,0.1,2,3,\n"),
      "shaft.csv:3:12: elements: a layer has the elements of the row that it lies on; leave them "
      "out\n");
  EXPECT_EQ(
      problems_in(head + "1,0.1,0,1,,\n,0.2,,2,,\n"),
      "shaft.csv:3:6: inner_diameter: missing, expected the inner diameter (m) of the layer at "
      "both ends\n");
  EXPECT_EQ(problems_in(head + "1,0.1,0,1.5,,\n"),
            "shaft.csv:2:9: layer: found 1.5, expected a whole number from 1 to 1000\n");
  EXPECT_EQ(
      problems_in(head + "1,0.1,0,1,,mass\n"),
      "shaft.csv:2:12: carries: the shaft itself carries both; layers have a number above 1\n");
  EXPECT_EQ(problems_in(head + "1,0.1,0,1,,\n,0.2,0.1,2,,weight\n"),
            "shaft.csv:3:13: carries: found \"weight\", expected one of both, stiffness, mass\n");
}

TEST(ShaftTable, ColumnsThatCannotBe) {
  EXPECT_EQ(problems_in("lenght,outer_diameter\n1,2\n"),
            "shaft.csv:1:1: lenght: unknown column, did you mean \"length\"?\n");
  EXPECT_EQ(problems_in("outer_diameter\n2\n"),
            "shaft.csv:1:1: length: missing, expected a column of lengths, as length [mm]\n");
  EXPECT_EQ(
      problems_in("length\n2\n"),
      "shaft.csv:1:1: outer_diameter: missing, expected a column outer_diameter, or outer_left "
      "and outer_right\n");
  EXPECT_EQ(problems_in("length,outer_left\n2,1\n"),
            "shaft.csv:1:1: outer_right: missing, expected a column for the other end, too\n");
  EXPECT_EQ(problems_in("length,od,outer_left\n2,1,1\n"),
            "shaft.csv:1:1: outer_diameter: found outer_diameter and outer_left or outer_right, "
            "expected one value or one for each end\n");
  EXPECT_EQ(problems_in("length [kg],od\n2,1\n"),
            "shaft.csv:1:1: length: the unit [kg] does not fit: found \"1 kg\", expected a length "
            "(m)\n");
  EXPECT_EQ(problems_in("length,od,material [m]\n2,1,a\n"),
            "shaft.csv:1:11: material: a column of words has no unit\n");
  EXPECT_EQ(problems_in("length,od,l\n2,1,2\n"),
            "shaft.csv:1:11: length: this column is there already\n");
  for (const char* text : {"", "# nothing\n", "length,od\n"}) {
    EXPECT_NE(problems_in(text).find("shaft.csv: the table has no rows"), std::string::npos)
        << text;
  }
}

using ShaftTableFile = InResultFolder;

constexpr const char* head = R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[material.bronze]
density = 8800
youngs_modulus = "100 GPa"
poisson_ratio = 0.34
)";

// A shaft by a table is that of the same segments and layers, and results keep the table's text.
TEST_F(ShaftTableFile, IsTheShaftOfTheSameSegments) {
  std::ofstream(folder / "stations.csv")
      << "length [mm], od [mm], id [mm], material, layer, elements\n"
         "200, 40, 0, , 1, 4\n"
         ", 70, 40, bronze, 2,\n"
         "300, 50, 0, , 1, 5\n";
  const std::string by_table = std::string(head) + R"([[shaft]]
table = "stations.csv"
material = "steel"
theory = "rayleigh"
rayleigh = { stiffness = "2 us" }
[[shaft]]
material = "bronze"
length = "100 mm"
outer_diameter = "30 mm"
elements = 2
)";
  const std::string by_hand = std::string(head) + R"([[shaft]]
material = "steel"
length = "200 mm"
outer_diameter = "40 mm"
elements = 4
theory = "rayleigh"
rayleigh = { stiffness = "2 us" }
[[shaft]]
material = "steel"
length = "300 mm"
outer_diameter = "50 mm"
elements = 5
theory = "rayleigh"
rayleigh = { stiffness = "2 us" }
[[shaft]]
material = "bronze"
length = "100 mm"
outer_diameter = "30 mm"
elements = 2
[[layer]]
from = 0
to = "200 mm"
material = "bronze"
outer_diameter = "70 mm"
inner_diameter = "40 mm"
theory = "rayleigh"
rayleigh = { stiffness = "2 us" }
)";
  const Model model = parse_model(by_table, "m.toml", {}, folder);
  const System a = assemble(model.structure, 100.0),
               b = assemble(parse_model(by_hand).structure, 100.0);
  EXPECT_EQ(Mat(a.M - b.M).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(Mat(a.K - b.K).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(Mat(a.C - b.C).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(Mat(a.C).cwiseAbs().maxCoeff(), 0.0);

  std::filesystem::remove(folder / "stations.csv");
  const Model again = parse_model(model.source, "result.h5");
  EXPECT_EQ(again.structure.shaft.size(), 3u);
  EXPECT_EQ(again.structure.layers.size(), 1u);
  EXPECT_EQ(again.structure.shaft[1].where.file, "result.h5:14: shaft.1.table");
}

TEST_F(ShaftTableFile, ProblemsOfTableAndModelAreToldTogether) {
  const auto problem_of = [&](const std::string& table, const std::string& keys) {
    std::ofstream(folder / "t.csv") << table;
    std::string all;
    try {
      parse_model(std::string(head) + "[[shaft]]\ntable = \"t.csv\"\n" + keys, "m", {}, folder);
    } catch (const ModelError& error) {
      for (const Problem& p : error.problems()) {
        const std::string text = describe(p), beside = (folder / "").string();
        all += (text.starts_with(beside) ? text.substr(beside.size()) : text) + "\n";
      }
    }
    return all;
  };
  const std::string good = "length,od,material\n1,0.1,steel\n";
  EXPECT_EQ(problem_of(good, "[[disk]]\nat = 0.5\nmass = 1\n"), "");
  EXPECT_EQ(
      problem_of("length,od,material\n1,0.1,steal\n1,0.1,\n", "[[disk]]\nat = 0.5\nmas = 1\n"),
      "m:14:1: disk.1.mas: unknown key, did you mean \"mass\"?\n"
      "t.csv:2:7: material: found \"steal\", expected one of bronze, steel; did you mean "
      "\"steel\"?\n"
      "t.csv:3:7: material: missing, expected the name of a material\n");
  EXPECT_EQ(problem_of("length,od,material\n1,0.1,AISI4140\n1,0.1,AISI4140\n1,1,AISI4140\n", ""),
            "t.csv:2:7: material: found \"AISI4140\", expected one of bronze, steel; and 2 more "
            "rows\n");
  EXPECT_EQ(problem_of(good, "length = 2\n"),
            "m:12:10: shaft.1.length: stands in the table; leave it out\n");
  EXPECT_EQ(problem_of(good, "[[shaft]]\ntable = \"other.csv\"\n")
                .find("m:13:9: shaft.2.table: cannot read the file"),
            0u);
  // stations beyond the ends of a shaft that is not whole are no matter
  EXPECT_EQ(problem_of("length,od\n1,0.1\n", "[[disk]]\nat = 5\nmass = 1\n"),
            "t.csv:2:1: material: missing, expected the name of a material\n");
}

// Masses, unbalances and parts of a station table are those of [[disk]], [[unbalance]] and of
// tables with stations of their own.
TEST_F(ShaftTableFile, StationsAreThoseOfTablesWithPlaces) {
  const std::string bearing = "stiffness = \"10 MN/m\"\n";
  std::ofstream(folder / "stations.csv")
      << "length [mm],od [mm],added mass [kg],polar inertia [kg.m2],It [kg.m2],unbalance [g.mm],"
         "unbalance angle [deg],bearing\n"
         "100,40,,,,,,DE\n200,40,3,0.02,0.011,50,90,\n,,,,,,,ghost/2\n";
  const std::string by_table = std::string(head) +
                               "[[shaft]]\ntable = \"stations.csv\"\nmaterial = \"steel\"\n" +
                               "[[bearing]]\nname = \"DE\"\n" + bearing + "[[bearing]]\n" + bearing;
  const std::string shaft =
      "[[shaft]]\nmaterial = \"steel\"\nouter_diameter = \"40 mm\"\nlength = ";
  const std::string by_hand =
      std::string(head) + shaft + "\"100 mm\"\n" + shaft + "\"200 mm\"\n" +
      "[[disk]]\nat = \"100 mm\"\nmass = 3\npolar_inertia = 0.02\ndiametral_inertia = 0.011\n"
      "[[unbalance]]\nat = \"100 mm\"\nmoment = \"50 g.mm\"\nphase = \"90 deg\"\n"
      "[[bearing]]\nat = 0\n" +
      bearing + "[[bearing]]\nat = \"300 mm\"\n" + bearing;
  const Model model = parse_model(by_table, "m.toml", {}, folder), other = parse_model(by_hand);
  const System a = assemble(model.structure, 100.0), b = assemble(other.structure, 100.0);
  EXPECT_EQ(Mat(a.M - b.M).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(Mat(a.K - b.K).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(Mat(a.G() - b.G()).cwiseAbs().maxCoeff(), 0.0);
  ASSERT_EQ(model.structure.unbalances.size(), 1u);
  EXPECT_DOUBLE_EQ(model.structure.unbalances[0].moment, 50e-6);
  std::string told;
  for (const Problem& p : model_doubts(by_table, "m.toml", {}, folder)) told += describe(p) + "\n";
  EXPECT_NE(told.find("stations.csv:4:8: bearing: the model has no [[bearing]] with name = "
                      "\"ghost\""),
            std::string::npos)
      << told;
  // what has a station of its own is there
  const Model own = parse_model(by_table + "at = \"50 mm\"\n", "m.toml", {}, folder);
  EXPECT_EQ(own.structure.bearings[1].from.z, 0.05);
}

}  // namespace shaft_table_test
}  // namespace whirl::test
