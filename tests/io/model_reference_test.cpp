// docs/model-file.md against the reader: its examples are models, and it names every key.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "libio/model/model_file.hpp"

namespace whirl::model_reference_test {

std::string manual() {
  std::ostringstream text;
  text << std::ifstream(WHIRL_SOURCE_DIR "/docs/model-file.md").rdbuf();
  return text.str();
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (auto at = text.find(separator); at != std::string::npos; at = text.find(separator, start)) {
    parts.push_back(text.substr(start, at - start));
    start = at + separator.size();
  }
  parts.push_back(text.substr(start));
  return parts;
}

TEST(ModelReference, EveryExampleIsAModel) {
  int examples = 0;
  for (const std::string& part : split(manual(), "```toml\n")) {
    if (!part.starts_with("format")) continue;
    ++examples;
    const std::string text = part.substr(0, part.find("```"));
    EXPECT_NO_THROW(parse_model(text, "docs/model-file.md")) << text;
  }
  EXPECT_GE(examples, 4);
}

/// A model whose table of one kind has a key that nobody could have meant.
struct Table {
  const char* heading;  ///< in the manual
  const char* text;
};

TEST(ModelReference, EveryKeyThatTheReaderKnowsStandsInItsSection) {
  const std::string base = R"(format = 1
[material.m]
density = 1
youngs_modulus = 2
poisson_ratio = 0
[[shaft]]
material = "m"
length = 1
outer_diameter = 1
[[body]]
name = "b"
mass = 1
spins = true
)";
  const Table tables[] = {
      {"## Top of the file", "qqqqqqqq = 1\n"},
      {"## `[operation]`", "[operation]\nqqqqqqqq = 1\n"},
      {"## `[material.NAME]`",
       "[material.n]\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0\n"
       "qqqqqqqq = 1\n"},
      {"## `[[shaft]]`",
       "[[shaft]]\nmaterial = \"m\"\nlength = 1\nouter_diameter = 1\nqqqqqqqq = 1\n"},
      {"## `[[shaft]]`",
       "[[shaft]]\nmaterial = \"m\"\nlength = 1\nouter_diameter = 1\n"
       "rayleigh = { qqqqqqqq = 1 }\n"},
      {"## `[[layer]]`",
       "[[layer]]\nfrom = 0\nto = 1\nmaterial = \"m\"\nouter_diameter = 2\ninner_diameter = 1\n"
       "qqqqqqqq = 1\n"},
      {"## `[bow]`", "[bow]\ntable = \"z, x\\n0, 0\\n1, 1\"\nqqqqqqqq = 1\n"},
      {"## `[[disk]]`",
       "[[disk]]\nnode = 1\nmaterial = \"m\"\nouter_diameter = 1\nwidth = 1\n"
       "qqqqqqqq = 1\n"},
      {"## `[[unbalance]]`", "[[unbalance]]\nbody = \"b\"\nmoment = 1\nqqqqqqqq = 1\n"},
      {"## `[[force]]`", "[[force]]\nbody = \"b\"\nforce = 1\nqqqqqqqq = 1\n"},
      {"## `[[probe]]`", "[[probe]]\nbody = \"b\"\nangle = 0\nqqqqqqqq = 1\n"},
      {"## `[[body]]`", "[[body]]\nname = \"c\"\nmass = 1\nqqqqqqqq = 1\n"},
      {"## `[[bearing]]`", "[[bearing]]\nbody = \"b\"\nstiffness = 1\nqqqqqqqq = 1\n"},
      {"## `[[bearing]]`",
       "[[bearing]]\nbody = \"b\"\nstiffness = { xx = 1, yy = 1, qqqqqqqq = 1 }\n"},
      {"## `[[seal]]`", "[[seal]]\nbody = \"b\"\nstiffness = 1\nqqqqqqqq = 1\n"},
      {"## `[[link]]`", "[[link]]\nfrom = \"b\"\nto = \"ground\"\nstiffness = 1\nqqqqqqqq = 1\n"},
      {"## `[[contact]]`",
       "[[contact]]\nbody = \"b\"\nclearance = 1\nstiffness = 1\nqqqqqqqq = 1\n"},
      {"## `[[oil_film]]`",
       "[[oil_film]]\nbody = \"b\"\nradius = 1\nlength = 1\nclearance = 1\nviscosity = 1\n"
       "law = \"squeeze\"\nqqqqqqqq = 1\n"},
      {"## `[damping]`", "[damping]\nqqqqqqqq = 1\n"},
      {"## `[damping]`", "[damping]\nrayleigh = { qqqqqqqq = 1 }\n"},
      {"## `[reduction]`", "[reduction]\nqqqqqqqq = 1\n"},
      {"## `[start]`", "[start]\nqqqqqqqq = 1\n"},
      {"## `[start]`", "[start]\nwhirl = [ { mode = 1, amplitude = 1, qqqqqqqq = 1 } ]\n"},
  };
  const std::string text = manual();
  for (auto at = text.find("\n## `["); at != std::string::npos; at = text.find("\n## `[", at + 1)) {
    const std::string heading = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    EXPECT_TRUE(std::any_of(std::begin(tables), std::end(tables),
                            [&](const Table& table) { return table.heading == heading; }))
        << heading << " is not tried";
  }
  for (const Table& table : tables) {
    SCOPED_TRACE(table.heading);
    const auto from = text.find(table.heading);
    ASSERT_NE(from, std::string::npos);
    const std::string section = text.substr(from, text.find("\n## ", from + 1) - from);
    const bool is_top = std::string(table.text).starts_with('q');
    try {
      parse_model(is_top ? table.text + base : base + table.text);
      FAIL() << "the key was taken";
    } catch (const ModelError& error) {
      ASSERT_EQ(error.problems().size(), 1u) << error.what();
      const std::string start = "unknown key, known here: ";
      const std::string message = error.problems()[0].message;
      ASSERT_TRUE(message.starts_with(start)) << message;
      for (const std::string& key : split(message.substr(start.size()), ", ")) {
        const bool is_table = is_top && text.find("[" + key) != std::string::npos;
        const bool is_named = section.find("`" + key + "`") != std::string::npos ||
                              section.find(" " + key) != std::string::npos;
        EXPECT_TRUE(is_table || is_named) << key;
      }
    }
  }
}

}  // namespace whirl::model_reference_test
