// Tables for the terminal.

#include "libio/table.hpp"

#include <gtest/gtest.h>

#include <sstream>

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

}  // namespace whirl::table_test
