// Pictures as files: their sizes, letters and formats.

#include "libio/drawing/picture_file.hpp"

#include <gtest/gtest.h>

#include "libbase/system/program.hpp"
#include "libio/results/own_file.hpp"
#include "libio/text/option_values.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace picture_file_test {

// An inch is 25.4 mm and has 72 points.
TEST(PrintedSides, HaveAUnitOfBothOrOneOfEach) {
  for (const auto& [text, width, height] : {std::tuple{"85x60mm", 85.0, 60.0},
                                            {"8.5cmx60mm", 85.0, 60.0},
                                            {"4x3in", 101.6, 76.2},
                                            {"144x72pt", 50.8, 25.4}}) {
    const auto sides = parse_sides(text);
    ASSERT_TRUE(sides) << text;
    EXPECT_DOUBLE_EQ(sides->width, width) << text;
    EXPECT_DOUBLE_EQ(sides->height, height) << text;
  }
}

TEST(PrintedSides, AreRefusedWithWhatWouldBeRight) {
  for (const char* text :
       {"", "85", "85x60", "85mmx60", "1x1mm", "-85x60mm", "axbmm", "85x9999999mm", "85x60mm "}) {
    EXPECT_EQ(parse_sides(text).problem,
              "expected a size such as 85x60mm (mm, cm, in, pt), of 20 to 2000 mm")
        << text;
  }
}

TEST(Letters, ArePointsWithoutUnit) {
  EXPECT_EQ(*parse_font("8"), 8.0);
  EXPECT_EQ(*parse_font("7.5"), 7.5);
  for (const char* text : {"", "0", "3", "41", "8pt", "nan", "-8", "1e1"}) {
    EXPECT_EQ(parse_font(text).problem, "expected points, 4 to 40") << text;
  }
}

TEST(PictureFormat, IsThatOfItsNameOrOfTheFile) {
  EXPECT_EQ(*parse_choice<PictureFormat>("pdf"), PictureFormat::pdf);
  EXPECT_FALSE(parse_choice<PictureFormat>("gif"));
  EXPECT_FALSE(parse_choice<PictureFormat>(""));
  EXPECT_EQ(*picture_format_of("a.svg/b.png"), PictureFormat::png);
  for (const char* file : {"png", "a.png.txt", "a.", ""}) {
    EXPECT_FALSE(picture_format_of(file)) << file;
  }
}

using PictureFile = InResultFolder;

constexpr const char* svg =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"30\">"
    "<rect width=\"40\" height=\"30\"/></svg>";

TEST_F(PictureFile, HoldsTheSvgAsItIs) {
  write_picture(svg, folder / "a.svg", {});
  EXPECT_EQ(content(folder / "a.svg"), svg);
  EXPECT_EQ(files(), 1u);
}

// A screen's picture has two pixels per pixel of the drawing; the file is one of this program, and
// nothing is left beside it.
TEST_F(PictureFile, IsConvertedAndMarked) {
  if (run_program({"rsvg-convert", "--version"}, folder / "version") != 0) {
    GTEST_SKIP() << "no rsvg-convert";
  }
  std::filesystem::remove(folder / "version");
  write_picture(svg, folder / "a.png", {.format = PictureFormat::png});
  EXPECT_EQ(content(folder / "a.png").substr(16, 8), std::string("\0\0\0\120\0\0\0\074", 8));
  EXPECT_EQ(origin_of(folder / "a.png"), Origin::picture);
  EXPECT_EQ(files(), 1u);
}

TEST_F(PictureFile, IsNotThereWhereItCannotBeConverted) {
  EXPECT_NE(problem_of([&] {
              write_picture("no picture", folder / "a.pdf", {.format = PictureFormat::pdf});
            }).find("cannot write"),
            std::string::npos);
  EXPECT_EQ(files(), 0u);
}

}  // namespace picture_file_test
}  // namespace whirl::test
