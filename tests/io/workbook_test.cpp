// Tables in workbooks: stations.xlsx is one as openpyxl writes it (texts in their cells, parts with
// absolute names), shared_strings.xlsx one of libxlsxwriter (shared texts, relative names).

#include "libio/text/workbook.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "libio/model/model_doubts.hpp"
#include "libio/model/model_file.hpp"
#include "libio/model/shaft_table.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/file_bytes.hpp"
#include "tests/io/problems.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace workbook_test {

const std::filesystem::path tables = std::filesystem::path(WHIRL_TEST_DATA) / "tables";

std::string bytes_of(const char* name) {
  const auto bytes = file_bytes(tables / name, FileKind::regular, most_text_bytes);
  EXPECT_TRUE(bytes) << bytes.problem;
  return bytes.value.value_or("");
}

std::string model_with(const std::string& tables_of_model) {
  return R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
)" + tables_of_model;
}

std::string problems_of(const std::string& text) {
  std::string all;
  try {
    parse_model(text, "m.toml", {}, tables);
  } catch (const ModelError& error) {
    for (const Problem& p : error.problems()) all += describe(p) + "\n";
  }
  return all;
}

TEST(Workbook, SheetsAreLinesAndCells) {
  const auto sheets = sheets_of(bytes_of("stations.xlsx"));
  ASSERT_TRUE(sheets) << sheets.problem;
  ASSERT_EQ(sheets->size(), 4u);
  EXPECT_EQ((*sheets)[0].name, "Cover");
  EXPECT_TRUE((*sheets)[2].is_hidden);
  const std::string mark(1, cell_mark);
  EXPECT_EQ((*sheets)[0].text, "Rotor 7" + mark + "\ndrawing \"A3\", (sheet 2" + mark + "\n");
  const std::string& text = (*sheets)[1].text;  // row 7 has the result of a formula
  EXPECT_NE(text.find("\n" + mark + "3" + mark + "120" + mark + "40"), std::string::npos) << text;
}

// The sheet is found by the names of its columns; titles, notes and the hidden sheet are left.
TEST(Workbook, ShaftAndBearingFindTheirSheets) {
  const Model model = parse_model(model_with(R"([[shaft]]
table = "stations.xlsx"
[[bearing]]
at = 0
table = "stations.xlsx"
)"),
                                  "m.toml", {}, tables);
  const Structure& s = model.structure;
  ASSERT_EQ(s.shaft.size(), 3u);
  EXPECT_DOUBLE_EQ(s.shaft[1].length, 0.1505);
  EXPECT_DOUBLE_EQ(s.shaft[2].length, 0.12);
  ASSERT_EQ(s.disks.size(), 2u);
  EXPECT_DOUBLE_EQ(s.disks[0].Ip, 8e-3);
  EXPECT_DOUBLE_EQ(s.disks[1].at.z, s.length());
  const Model again = parse_model(model.source, "result.h5");  // a result has the sheets in it
  EXPECT_EQ(again.structure.shaft.size(), 3u);
  ASSERT_EQ(again.structure.disks.size(), 2u);
  EXPECT_EQ(again.structure.disks[0].m, s.disks[0].m);
}

TEST(Workbook, SharedTextsAndHeadsInGerman) {
  const std::string text = model_with(
      "[[shaft]]\ntable = \"shared_strings.xlsx\"\n"
      "[[bearing]]\nname = \"A\"\nstiffness = 1e7\n[[bearing]]\nname = \"B\"\nstiffness = 1e7\n");
  const Model model = parse_model(text, "m.toml", {}, tables);
  ASSERT_EQ(model.structure.shaft.size(), 3u);
  EXPECT_DOUBLE_EQ(model.structure.shaft[1].left.inner, 0.01);
  EXPECT_DOUBLE_EQ(model.structure.bearings[1].from.z, 0.2505);
  EXPECT_TRUE(model_doubts(text, "m.toml", {}, tables).empty());
}

// A sheet and a range behind the name; a problem says its cell.
TEST(Workbook, SheetAndRangeAreSaidAndCellsNamed) {
  const auto shaft = [](const std::string& name) {
    return model_with("[[shaft]]\ntable = \"" + name + "\"\n");
  };
  const Model model = parse_model(shaft("stations.xlsx#Rotor Model!B4:H6"), "m.toml", {}, tables);
  EXPECT_EQ(model.structure.shaft.size(), 2u);
  EXPECT_EQ(problems_of(shaft("stations.xlsx#'Rotor Model'!B4:D6")),
            (tables / "stations.xlsx#Rotor Model!A5").string() +
                ": material: missing, expected the name of a material; and 1 more row\n");
  EXPECT_NE(problems_of(shaft("stations.xlsx#Rotor")).find("it has no sheet \"Rotor\"; there are"),
            std::string::npos);
  EXPECT_NE(problems_of(shaft("stations.xlsx#Cover!4:7")).find("expected one such as B4:H25"),
            std::string::npos);
  EXPECT_NE(problems_of("format = 1\n[bow]\ntable = \"shared_strings.xlsx\"\n")
                .find("has a line that names columns of this table"),
            std::string::npos);
}

// Whatever is cut off or changed is an error or read, never a crash; and other archives are told.
TEST(Workbook, DamagedFilesAreErrors) {
  const std::string whole = bytes_of("shared_strings.xlsx");
  for (std::size_t size = 4; size < whole.size(); size += 97) {
    EXPECT_FALSE(sheets_of(whole.substr(0, size))) << size;
  }
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    const auto sheets = sheets_of(changed);
    EXPECT_NE(static_cast<bool>(sheets), !sheets.problem.empty()) << at;
  }
}

}  // namespace workbook_test
}  // namespace whirl::test
