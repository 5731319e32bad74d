// What is printed fits the terminal.

#include <cstdlib>

#include "libio/text/table.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace terminal_test {

class Terminal : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    ::setenv("COLUMNS", "80", 1);  // of the programs that are started
  }
  void TearDown() override {
    ::unsetenv("COLUMNS");
    Program::TearDown();
  }

  /// Lines that are wider than 80 columns and could be folded.
  std::string too_wide(const std::string& text) const {
    std::istringstream stream(text);
    std::string found;
    for (std::string line; std::getline(stream, line);) {
      const bool is_a_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      if (display_width(line) > 80 && !is_a_word) found += line + "\n";
    }
    return found;
  }
};

// Every verb that is quick on every bundled model.
TEST_F(Terminal, NoLineIsWiderThanIt) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(WHIRL_SOURCE_DIR "/models")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string model = entry.path();
    const std::vector<std::vector<std::string>> calls{
        {"check", model},
        {"static", model},
        {"modes", model, "--modes", "12"},
        {"campbell", model, "--speeds", "100:3000:1450rpm", "--modes", "12"},
        {"critical", model},
        {"unbalance", model, "--speeds", "100:3000:580rpm", "--stations", "all"},
        {"simulate", model, "--revolutions", "4", "--discard", "0"},
        {"identify", model, "--revolutions", "8", "--discard", "0", "--modes", "12"}};
    for (const std::vector<std::string>& words : calls) {
      const Outcome outcome = whirl(words);
      EXPECT_EQ(too_wide(outcome.out), "") << words[0] << " " << model;
    }
  }
}

// A title, a station's name and the name of a file can hold escape sequences: none comes to the
// terminal, and JSON and result have what was written.
TEST_F(Terminal, NamesOfStrangersDoNotSteerIt) {
  const std::string clear = "\x1b[2J", shown = "\ufffd[2J";
  std::string model = jeffcott;
  model.replace(model.find("Jeffcott"), 1, "\\u001b[2J\\u009b\\u202e");
  model.replace(model.find("\"shaft\""), 1, "\"\\u001b[2J");
  write("m.toml", model);
  write("wrong" + clear + ".toml", "format = 1\nspeeed = \"" + std::string("\u009b31m") + "\"\n");
  const std::vector<std::vector<std::string>> calls{
      {"check", "m.toml"},
      {"static", "m.toml"},
      {"modes", "m.toml", "--speed", "900rpm", "--out", "m.h5"},
      {"static", "m.toml", "--json", "-"},
      {"report", "m.h5", "--out", "m.html"},
      {"check", "wrong" + clear + ".toml"},
      {"check", "none" + clear + ".toml"},
      {clear},
      {"check", "m.toml", "--" + clear, "x"}};
  for (const std::vector<std::string>& words : calls) {
    const Outcome outcome = whirl(words);
    for (const std::string& text : {outcome.out, outcome.err}) {
      for (const char* steering : {"\x1b", "\u009b", "\u202e"}) {
        EXPECT_FALSE(has(text, steering)) << words[0] << ": " << text;
      }
    }
    if (words.back() == "-") {
      EXPECT_TRUE(has(outcome.out, "\\u001b")) << outcome.out;
    }
  }
  EXPECT_TRUE(has(whirl({"check", "m.toml"}).out, shown));
}

// A name or title in several lines is no line of the program's own.
TEST_F(Terminal, NamesOfStrangersMakeNoLines) {
  std::string model = jeffcott;
  for (const std::string& word : {std::string("Jeffcott"), std::string("shaft")}) {
    model.replace(model.find(word), word.size(), word + "\\nspoofed: passed");
  }
  for (auto at = model.find("\"rotor\""); at != model.npos; at = model.find("\"rotor\"", at + 9)) {
    model.replace(at, 7, "\"rotor\\r\\nspoofed: passed\"");
  }
  write("lines.toml", model);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"check", "lines.toml"},
                                             {"static", "lines.toml"},
                                             {"modes", "lines.toml", "--speed", "900rpm"},
                                             {"simulate", "lines.toml", "--speed", "900rpm",
                                              "--discard", "0", "--revolutions", "3"}}) {
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(has(outcome.out, "\nspoofed")) << outcome.out;
  }
}

// The same calls with further verbs on one model of few dofs.
TEST_F(Terminal, NeitherOfStudies) {
  write("rub.toml", rubbing);
  for (const std::string& verb : model_verbs) {
    std::vector<std::string> words = briefly({verb, "rub.toml"});
    words.insert(words.end(), {"--out", "r.h5"});
    EXPECT_EQ(too_wide(whirl(words).out), "") << verb;
    if (!std::filesystem::exists(folder / "r.h5")) continue;
    EXPECT_EQ(too_wide(whirl({"plot", "r.h5"}).out), "") << "plot of " << verb;
    std::filesystem::remove(folder / "r.h5");
  }
}

// In a pipe every row is a line, as programs that read tables had it; with COLUMNS nothing is lost.
TEST_F(Terminal, APipeHasRowsOfOneLine) {
  const std::vector<std::string> words{"unbalance", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml",
                                       "--speeds", "0:8000:400rpm"};
  const std::string narrow = whirl(words).out;
  ::unsetenv("COLUMNS");
  const std::string wide = whirl(words).out;
  const auto signs = [](std::string text) {  // blanks and rules aside
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n' || (c & 0x80) != 0; });
    return text.size();
  };
  EXPECT_GE(signs(narrow), signs(wide));
  EXPECT_GT(too_wide(wide).size(), 0u);
}

}  // namespace terminal_test
}  // namespace whirl::test
