// Tables for the terminal.

#include "libio/text/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "libio/text/table_text.hpp"
#include "libio/text/terminal.hpp"

namespace whirl::table_test {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

TEST(Table, TextsGoLeftAndNumbersRight) {
  Table table({"mode", "frequency [rpm]", "whirl"});
  table.row({"1", "1664.6", "backward"});
  table.row({"12", "+22990.1", "forward"});
  EXPECT_EQ(table.text(),
            "  mode  frequency [rpm]  whirl\n"
            "  ────  ───────────────  ────────\n"
            "     1           1664.6  backward\n"
            "    12         +22990.1  forward\n");
}

TEST(Table, SignsOfNothingCountAsNumbers) {
  Table table({"mac", "name"});
  table.row({"·", "a"});
  table.row({"0.25", "b"});
  table.row({"-", "c"});
  table.row({"", "d"});
  EXPECT_EQ(table.text(),
            "   mac  name\n"
            "  ────  ────\n"
            "     ·  a\n"
            "  0.25  b\n"
            "     -  c\n"
            "        d\n");
}

TEST(Table, ColumnsAreEqualBeyondAscii) {
  Table table({"Läufer", "µ"});
  table.row({"Dichtung", "0.1"});
  table.row({"Gehäuse", "0.25"});
  std::vector<std::size_t> widths;
  for (const std::string& line : lines(table.text())) widths.push_back(display_width(line));
  EXPECT_EQ(widths, (std::vector<std::size_t>{16, 16, 16, 16}));
  EXPECT_EQ(display_width("Gehäuse ─ µ"), 11u);
  EXPECT_EQ(display_width(""), 0u);
}

TEST(Table, ShortRowsAndNoRowsAreFine) {
  Table table({"a", "b"});
  EXPECT_EQ(table.text(), "  a  b\n  ─  ─\n");
  table.row({"x"});
  table.row({});
  EXPECT_EQ(table.text(), "  a  b\n  ─  ─\n  x\n\n");
}

/// The widest line.
std::size_t width_of(const std::string& text) {
  std::size_t width = 0;
  for (const std::string& line : lines(text)) width = std::max(width, display_width(line));
  return width;
}

// Heads of numbers are folded first: nothing else changes.
TEST(Table, FoldsHeadsOfNumbersWhereTheyDoNotFit) {
  const std::vector<std::string> head{"mode", "natural frequency [rpm]", "whirl"};
  const std::vector<std::vector<std::string>> rows{{"1", "1664.6", "backward"}};
  EXPECT_EQ(table_text(head, rows, 30),
            "  mode    natural  whirl\n"
            "        frequency\n"
            "            [rpm]\n"
            "  ────  ─────────  ────────\n"
            "     1     1664.6  backward\n");
  EXPECT_EQ(table_text(head, rows, 0), table_text(head, rows, 80));
}

TEST(Table, FoldsItsWidestText) {
  const std::vector<std::vector<std::string>> rows{
      {"orbit", "path of a station, seen from the ground and from the rotor"}, {"mac", "short"}};
  EXPECT_EQ(table_text({"kind", "shows"}, rows, 40),
            "  kind   shows\n"
            "  ─────  ───────────────────────────────\n"
            "  orbit  path of a station, seen from\n"
            "         the ground and from the rotor\n"
            "  mac    short\n");
}

// Columns of numbers that find no place follow below, each block with the first column: every cell
// is there, once.
TEST(Table, ContinuesBelowWithTheFirstColumnAgain) {
  std::vector<std::string> head{"speed"}, cells{"4430"};
  for (int i = 0; i < 20; ++i) {
    head.push_back("mode" + std::to_string(i));
    cells.push_back(std::to_string(1000 + i) + ".5");
  }
  const std::string text = table_text(head, {cells}, 80);
  EXPECT_LE(width_of(text), 80u);
  for (int i = 0; i < 20; ++i) {
    const std::string cell = std::to_string(1000 + i) + ".5";
    EXPECT_NE(text.find(cell), std::string::npos) << cell;
    EXPECT_EQ(text.find(cell), text.rfind(cell)) << cell;
  }
  EXPECT_EQ(text.find("4430") == text.rfind("4430"), false);  // in every block
}

TEST(Folded, BreaksLinesAtBlanksAndKeepsTheirIndent) {
  EXPECT_EQ(folded("  one two three\nshort\n", 9), "  one two\n  three\nshort\n");
  EXPECT_EQ(folded("  one two three", 0), "  one two three");
  EXPECT_EQ(folded("/a/path/without/blanks\n", 10), "/a/path/without/blanks\n");
  EXPECT_EQ(folded("\n\na  b\n", 10), "\n\na  b\n");
}

// Names of any length and lists of peaks, which begin as numbers do, leave no line that a terminal
// would wrap.
TEST(Table, NoLineIsWiderThanTheTerminal) {
  const std::vector<std::string> head{"station", "largest radius",
                                      "strongest frequencies [rpm] (radius)",
                                      "seen from the rotor [rpm]"};
  const std::string peaks = "-3536.4 (368.2 um), +5789.5 (241.7 um), -12935.3 (112.1 um)";
  const std::vector<std::vector<std::string>> rows{
      {"4 left disk of the high pressure turbine rotor + left ring", "8.667 mm", peaks, peaks},
      {"9 " + std::string(200, 'x') + "äöü" + std::string(200, 'y'), "10.1 mm", peaks, peaks},
      {"13 right", "1.077 mm", peaks, peaks}};
  for (const std::size_t limit : {40, 80, 120}) {
    for (const std::string& line : lines(table_text(head, rows, limit))) {
      EXPECT_LE(display_width(line), limit) << line;
    }
  }
}

}  // namespace whirl::table_test
