// What names and titles of strangers can do to a terminal: nothing.

#include <gtest/gtest.h>

#include "libio/text/record.hpp"
#include "libio/text/terminal.hpp"

namespace whirl::shown_text_test {

// Escape sequences [ECMA-48: ESC, and CSI of one byte, which is two in UTF-8], a return to the
// begin of the line, signs that turn the direction of a text, and bytes that are no UTF-8. All else
// stays.
TEST(ShownText, SteersNoTerminal) {
  EXPECT_EQ(shown_text("\x1b[2Jtitle\x07"), "\ufffd[2Jtitle\ufffd");
  EXPECT_EQ(shown_text("a\u009b31mb\x7f"), "a\ufffd31mb\ufffd");
  EXPECT_EQ(shown_text("ok\rno"), "ok\ufffdno");
  EXPECT_EQ(shown_text("a\u202eb\u2066c\u200f"), "a\ufffdb\ufffdc\ufffd");
  EXPECT_EQ(shown_text("\xb5m \xe2\x80"), "\ufffdm \ufffd\ufffd");
  const std::string text = "Läufer\t10 µm\n━ 𝜔 … – \u00a0\u2007";
  EXPECT_EQ(shown_text(text), text);
}

// JSON keeps every character, and shows a terminal only letters.
TEST(ShownText, JsonEscapesWhatSteers) {
  Record record;
  record.set("title", "\x1b[2J\u009b\x7f\u202e µ");
  const std::string json = record.json();
  EXPECT_NE(json.find(R"("\u001b[2J\u009b\u007f\u202e µ")"), std::string::npos) << json;
  EXPECT_EQ(shown_text(json), json);
}

}  // namespace whirl::shown_text_test
