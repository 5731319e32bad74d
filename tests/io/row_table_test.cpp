// Tables for people that come from the columns of their rows.

#include "libio/texts/row_table.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::row_table_test {

struct Row {
  std::string name;
  double speed = 0.0;   // [rad/s]
  double radius = 0.0;  // [m]
  double duty = 0.0;
  int station = 0;
  std::optional<double> mean_slip{};
  Whirl whirl = Whirl::forward;
  bool is_stable = false;
  std::vector<double> list{};

  double twice() const { return 2.0 * duty; }

  static constexpr auto columns() {
    return ColumnList{column("name", &Row::name, "", "name"),
                      column("speed", &Row::speed, "rad/s", "speed"),
                      column("radius", &Row::radius, "m", "radius"),
                      column("duty", &Row::duty, "", "share"),
                      column("station", &Row::station, "", "number").from_one(),
                      column("mean_slip", &Row::mean_slip, "m/s", "slip"),
                      column("whirl", &Row::whirl, "", "sense"),
                      column("stable", &Row::is_stable, "", "stability"),
                      column("twice", &Row::twice, "", "twice the share"),
                      column("list", &Row::list, "", "many")};
  }
};

std::vector<Row> rows() {
  return {{"seal", 100.0 * rpm, 12.5e-6, 0.25, 0, 0.5, Whirl::backward, true},
          {"", -1e-9, nan, 0.5, 6, {}, Whirl::forward, false}};
}

// keys, units and values all come from columns(); only digits are said here
TEST(RowTable, SaysKeysUnitsAndValuesOfColumns) {
  EXPECT_EQ(table_of(rows(), {shown("name"), shown("speed", "rpm", ".1f"), shown("radius"),
                              shown("duty", "%", ".0f"), shown("mean_slip", "", ".2f")}),
            "  name  speed [rpm]   radius  duty [%]  mean slip [m/s]\n"
            "  ────  ───────────  ───────  ────────  ───────────────\n"
            "  seal        100.0  12.5 um        25             0.50\n"
            "  -             0.0        -        50                -\n");
}

TEST(RowTable, SaysChoicesFlagsAndNumbersFromOne) {
  EXPECT_EQ(table_of(rows(), {row_number("row"), shown("station"), shown("whirl"), shown("stable"),
                              shown("twice", "", "+.1f")}),
            "  row  station  whirl     stable  twice\n"
            "  ───  ───────  ────────  ──────  ─────\n"
            "    1        1  backward  yes      +0.5\n"
            "    2        7  forward   no       +1.0\n");
}

TEST(RowTable, TakesOtherHeadingsAndTextsOfTheirOwn) {
  EXPECT_EQ(table_of(rows(), {shown("speed", "Hz", ".3f").as(""),
                              {"first", [](const Row& r) { return r.name.substr(0, 1); }},
                              {"mark", [](const Row&, int n) { return std::string(n, '-'); }}}),
            "   [Hz]  first  mark\n"
            "  ─────  ─────  ────\n"
            "  1.667  s         -\n"
            "  0.000           --\n");
}

// rows without columns have texts only
TEST(RowTable, TakesAnyRows) {
  EXPECT_EQ(
      table_of(std::vector<int>{4, 5}, {{"square", [](int n) { return std::to_string(n * n); }}}),
      "  square\n"
      "  ──────\n"
      "      16\n"
      "      25\n");
}

TEST(RowTable, RefusesWhatIsNoColumnOrNoUnitOfIt) {
  EXPECT_THROW(table_of(rows(), {shown("sped")}), std::logic_error);
  EXPECT_THROW(table_of(rows(), {shown("list")}), std::logic_error);
  EXPECT_THROW(table_of(rows(), {shown("speed", "mm", ".1f")}), std::logic_error);
}

TEST(RowTable, NumbersHaveNoMinusZeroAndNoEndlessDigits) {
  EXPECT_EQ(texts::number_text(-1e-9, ".2f"), "0.00");
  EXPECT_EQ(texts::number_text(-1e-9, "+.2f"), "+0.00");
  EXPECT_EQ(texts::number_text(-0.5, ".2f"), "-0.50");
  EXPECT_EQ(texts::number_text(1.23456e12, ".1f"), "1.235e+12");
  EXPECT_EQ(texts::number_text(nan, ".1f"), "-");
  EXPECT_EQ(texts::number_text(-1.0 / 0.0, ".1f"), "-∞");
}

}  // namespace whirl::row_table_test
