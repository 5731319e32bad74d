// docs/model-file.md against the reader: its examples are models, and it names every key.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "libio/model/model_file.hpp"
#include "libio/model/model_table.hpp"

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

/// A part of a model with a key that nobody could have meant.
struct WrongKey {
  std::string heading;  ///< of its section in the manual
  std::string text;
};

/// Every table with such a key, and tables in them.
std::vector<WrongKey> wrong_keys() {
  const std::string key = "qqqqqqqq = 1";
  std::vector<WrongKey> all{{"## Top of the file", key + "\n"}};
  const auto add = [&](std::string header, const std::string& example) {
    const std::string heading = "## `" + header + "`";
    if (const auto at = header.find("NAME"); at != std::string::npos)
      header.replace(at, 4, "other");
    all.push_back({heading, header + "\n" + example + "\n"});
  };
  for (const ModelTable& table : model_tables()) {
    add(table.header(), std::string(table.example) + key);
  }
  add("[[shaft]]",
      "material = \"steel\"\nlength = 1\nouter_diameter = 1\nrayleigh = { " + key + " }");
  add("[[bearing]]", "body = \"b\"\nstiffness = { xx = 1, yy = 1, " + key + " }");
  add("[damping]", "rayleigh = { " + key + " }");
  add("[start]", "whirl = [ { mode = 1, amplitude = 1, " + key + " } ]");
  return all;
}

TEST(ModelReference, EveryKeyThatTheReaderKnowsStandsInItsSection) {
  const std::string base = R"(format = 1
[material.steel]
density = 1
youngs_modulus = 2
poisson_ratio = 0
[[shaft]]
material = "steel"
length = 1
outer_diameter = 1
[[body]]
name = "b"
mass = 1
spins = true
)";
  const std::string text = manual();
  EXPECT_EQ(split(text, "\n## `[").size() - 1, model_tables().size());
  for (const WrongKey& table : wrong_keys()) {
    SCOPED_TRACE(table.heading);
    const auto from = text.find(table.heading);
    ASSERT_NE(from, std::string::npos);
    const std::string section = text.substr(from, text.find("\n## ", from + 1) - from);
    const bool is_top = table.text.starts_with('q');
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
