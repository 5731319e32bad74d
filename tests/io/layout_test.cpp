// The drawing of a rotor in the terminal.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "libio/drawing/terminal_layout.hpp"
#include "libio/model/model_file.hpp"
#include "libio/text/table.hpp"

namespace whirl::layout_test {

std::string draw(const std::string& parts, int columns = 72) {
  const Model model = parse_model(R"(
format = 1
[material.steel]
density = 7800
youngs_modulus = 211e9
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
)" + parts);
  return draw_layout(model, Assembler(model.structure), columns);
}

std::size_t widest(const std::string& text) {
  std::size_t width = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) width = std::max(width, display_width(line));
  return width;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

constexpr const char* all_parts = R"(
[[disk]]
name = "wheel"
at = "200 mm"
material = "steel"
outer_diameter = "200 mm"
width = "30 mm"
[[disk]]
name = "coupling"
at = "600 mm"
mass = 1.5
[[bearing]]
name = "left"
at = 0
stiffness = 1e6
[[bearing]]
name = "right"
at = "500 mm"
stiffness = 1e6
[[contact]]
name = "seal"
at = "300 mm"
clearance = "1 mm"
stiffness = 1e6
)";

TEST(Layout, EveryPartIsNamedWithItsPlace) {
  const std::string text = draw(all_parts);
  for (const char* label :
       {"wheel (200 mm)", "coupling (600 mm)", "left (0 mm)", "right (500 mm)", "seal (300 mm)"}) {
    EXPECT_EQ(count(text, label), 1u) << label << "\n" << text;
  }
  EXPECT_EQ(count(text, "▲"), 3u) << text;  // two bearings and the legend
  EXPECT_EQ(count(text, "◯"), 2u) << text;
  EXPECT_EQ(count(text, "┃"), 2u) << text;
  EXPECT_GT(count(text, "▓"), 10u);
  EXPECT_GE(count(text, "█"), 72u);
}

TEST(Layout, SealsHaveASignOfTheirOwn) {
  const std::string text =
      draw(std::string(all_parts) + "[[seal]]\nname = \"eye\"\nat = \"250 mm\"\nstiffness = 1\n");
  EXPECT_EQ(count(text, "eye (250 mm)"), 1u) << text;
  EXPECT_EQ(count(text, "≋"), 2u) << text;  // the seal and the legend
  EXPECT_EQ(count(draw(all_parts), "≋"), 0u);
}

// A disk by its mass has no size: it is a sign of its own that hides neither shaft nor wheels, and
// the legend says what it is. With its size it is drawn as one by its shape.
TEST(Layout, ADiskByItsMassIsASymbol) {
  const std::string text = draw(all_parts);
  EXPECT_EQ(count(text, "╎ disk, size not given (not to scale)"), 1u) << text;
  EXPECT_GE(count(text, "╎"), 3u) << text;  // above, below, and the legend
  EXPECT_LE(count(text, "╎"), 5u) << text;
  const std::string sized = draw(std::string(all_parts) +
                                 "[[disk]]\nname = \"hub\"\nat = 0\nmass = 1\n"
                                 "outer_diameter = \"200 mm\"\nwidth = \"40 mm\"\n");
  EXPECT_GT(count(sized, "▓"), count(text, "▓"));
  EXPECT_EQ(count(draw("[[disk]]\nat = 0\nmass = 1\n"), "▓"), 0u);
}

TEST(Layout, NoLineIsWiderThanAsked) {
  for (const int columns : {40, 72, 120}) {
    EXPECT_LE(widest(draw(all_parts, columns)), static_cast<std::size_t>(columns) + 2) << columns;
  }
}

TEST(Layout, NamesThatMeetGoToLinesOfTheirOwn) {
  std::string parts;
  for (int i = 1; i <= 6; ++i) {
    parts += "[[bearing]]\nname = \"bearing number " + std::to_string(i) +
             "\"\nat = \"300 mm\"\nstiffness = 1e6\n";
  }
  const std::string text = draw(parts);
  for (int i = 1; i <= 6; ++i) {
    EXPECT_EQ(count(text, "bearing number " + std::to_string(i) + " (300 mm)"), 1u) << text;
  }
}

TEST(Layout, ANameLongerThanTheDrawingLosesItsEnd) {
  const std::string text =
      draw("[[bearing]]\nat = 0\nstiffness = 1\nname = \"" + std::string(200, 'n') + "\"\n");
  EXPECT_LE(widest(text), 74u) << text;
  EXPECT_EQ(count(text, "n… (0 mm)"), 1u) << text;
}

TEST(Layout, ABareShaftAndAConeAreDrawn) {
  EXPECT_GE(count(draw(""), "█"), 72u);
  EXPECT_EQ(draw("").find("\n  \n"), std::string::npos);  // no line for marks that are not there
  const std::string cone = draw(
      "[[shaft]]\nmaterial = \"steel\"\nlength = \"600 mm\"\n"
      "outer_diameter = [\"20 mm\", \"200 mm\"]\n");
  EXPECT_GE(count(cone, "█"), 100u) << cone;
}

TEST(Layout, WithoutAShaftThereIsNothingToDraw) {
  const Model model = parse_model("format = 1\n[[body]]\nname = \"rotor\"\nmass = 1\n");
  EXPECT_EQ(draw_layout(model, Assembler(model.structure)), "");
}

}  // namespace whirl::layout_test
