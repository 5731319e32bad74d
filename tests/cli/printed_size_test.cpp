// plot --size: pictures as large as they are printed.

#include <algorithm>
#include <regex>

#include "tests/cli/pictures.hpp"

namespace whirl::test {
namespace printed_size_test {

class PrintedSize : public Pictures {};

/// Texts of an SVG picture that are not turned: where they are, from left to right and up to down.
struct ShownText {
  double left, right, top, floor, size;
  std::string text;
};

std::vector<ShownText> texts_in(const std::string& svg) {
  // letters of the fonts that SVG names are half as wide as high at least in the mean
  constexpr double letter_width = 0.5;
  std::vector<ShownText> all;
  const std::regex pattern(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" font-size=\"([0-9.]+)\"([^>]*)>([^<]+)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it) {
    const std::string more = (*it)[4];
    if (has(more, "rotate")) continue;
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]), size = std::stod((*it)[3]);
    const std::string text = (*it)[5];
    const double width = letter_width * size *
                         static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
                           return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
                         }));
    const double left = has(more, "\"end\"")      ? x - width
                        : has(more, "\"middle\"") ? x - 0.5 * width
                                                  : x;
    all.push_back({left, left + width, y - 0.7 * size, y, size, text});
  }
  return all;
}

// A column of a journal, 85 x 60 mm at 8 pt: the picture has that size and its letters theirs, and
// no text lies on another one or reaches out.
TEST_F(PrintedSize, APictureOfAJournalColumnIsReadable) {
  make({"unbalance", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds", "0:8000:100rpm"},
       "u.h5");
  make({"campbell", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds", "0:8000:400rpm"},
       "c.h5");
  make({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml"}, "m.h5");
  make({"static", WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml"}, "s.h5");
  constexpr double pixel = 8.0 / 12.0;  // [pt]: 12 pixels of the drawing are 8 pt
  constexpr double smallest = 11.0;     // [pixels], letters at points and in cells
  constexpr double width = 85.0 / 25.4 * 72.0 / pixel, height = 60.0 / 25.4 * 72.0 / pixel;
  for (const auto& [file, kind] : {std::pair{"u.h5", "bode"},
                                   {"u.h5", "polar"},
                                   {"u.h5", "deflection"},
                                   {"c.h5", "campbell"},
                                   {"c.h5", "log_decrement"},
                                   {"c.h5", "layout"},
                                   {"m.h5", "modes"},
                                   {"s.h5", "static"}}) {
    SCOPED_TRACE(kind);
    const std::string picture = std::string(kind) + ".picture";
    const json r = result({"plot", file, kind, "--size", "85x60mm", "--font", "8", "--no-title",
                           "--format", "svg", "--out", picture});
    EXPECT_EQ(r["files"], json::array({picture}));
    const std::string svg = content(folder / picture);
    EXPECT_TRUE(has(svg, "width=\"85mm\" height=\"60mm\""));
    EXPECT_FALSE(std::regex_search(svg, std::regex("Two-disk rotor [a-z ]+</text>")));
    const auto texts = texts_in(svg);
    EXPECT_GT(texts.size(), 5u);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const ShownText& a = texts[i];
      EXPECT_GE(a.size, smallest) << a.text;
      EXPECT_GE(a.left, -1.0) << a.text;
      EXPECT_LE(a.right, width + 1.0) << a.text;
      EXPECT_GE(a.top, -1.0) << a.text;
      EXPECT_LE(a.floor, height + 1.0) << a.text;
      for (std::size_t k = 0; k < i; ++k) {
        const ShownText& b = texts[k];
        const bool cross =
            a.left < b.right && b.left < a.right && a.top < b.floor && b.top < a.floor;
        EXPECT_FALSE(cross) << a.text << " on " << b.text;
      }
    }
  }
  // what has no room is said
  const Outcome told = whirl({"plot", "m.h5", "modes", "--size", "85x60mm", "--out", "m.svg"});
  EXPECT_TRUE(has(told.out, "no room for the table")) << told.out;
  EXPECT_TRUE(has(told.out, "of 6 panels")) << told.out;
  // a larger picture holds all
  EXPECT_EQ(result({"plot", "m.h5", "modes", "--size", "17x20cm", "--out", "m.svg"})["left_out"],
            json::array());
}

TEST_F(PrintedSize, RefusesSizesThatAreNone) {
  make({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml"}, "m.h5");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--size", "85"},
                                             {"--size", "85x60"},
                                             {"--size", "1x1mm"},
                                             {"--size", "axbmm"},
                                             {"--size", "85x9999999mm"},
                                             {"--font", "0"},
                                             {"--font", "8pt"},
                                             {"--font", "nan"},
                                             {"--format", "gif"},
                                             {"--format", ""}}) {
    std::vector<std::string> call{"plot", "m.h5", "modes", "--out", "p.svg"};
    call.insert(call.end(), words.begin(), words.end());
    const Outcome outcome = whirl(call);
    EXPECT_EQ(outcome.status, 2) << words[1];
    EXPECT_TRUE(has(outcome.err, words[0])) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "p.svg")) << words[1];
  }
}

}  // namespace printed_size_test
}  // namespace whirl::test
