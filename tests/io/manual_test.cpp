// The manual of model files: what it shows is read as it stands, and every key it names is known.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::manual_test {

std::string manual() {
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/model-file.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Blocks of a language.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
  std::vector<std::string> found;
  const std::string fence = "```";
  for (auto at = text.find(fence + language + "\n"); at != std::string::npos;
       at = text.find(fence + language + "\n", at)) {
    const auto begin = at + fence.size() + language.size() + 1, end = text.find(fence, begin);
    found.push_back(text.substr(begin, end - begin));
    at = end + fence.size();
  }
  return found;
}

TEST(Manual, ShowsWholeModelsThatAreAccepted) {
  const std::vector<std::string> models = blocks(manual(), "toml");
  EXPECT_GE(models.size(), 4u);
  for (const std::string& text : models) {
    try {
      const Model model = parse_model(text, "manual");
      make_scene(model);
    } catch (const ModelError& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  }
}

/// Whether a key is known in a table: with a nonsense value, the complaint is about the value.
void expect_known(const std::string& table, const std::string& key) {
  const std::string model = "format = 1\n" + table + "\n" + key + " = 1979-05-27\n";
  try {
    parse_model(model, "manual");
    ADD_FAILURE() << "accepted:\n" << model;
  } catch (const ModelError& error) {
    EXPECT_EQ(std::string(error.what()).find("unknown key"), std::string::npos) << error.what();
  }
}

// Keys in the tables of a section "## `[[disk]]`", those that a family shares in one row separated
// by commas, and the keys that a law or a kind adds, in rows that begin with its name.
TEST(Manual, NamesNoKeyThatTheReaderDoesNotKnow) {
  const std::string text = manual();
  const std::regex section(R"(\n## `(\[{1,2})(\w+)(\.NAME)?\]{1,2}`\n)");
  const std::regex row(R"(\n\| (`\w+`(?:, `\w+`)*) \|)"), key(R"(`(\w+)`)");
  const std::regex member(R"re(\n\| `"([\w-]+)"` \|[^|]*\|([^|]*)\|)re");
  int keys = 0;
  std::map<std::string, std::size_t> members;  // by the table that names them
  for (std::sregex_iterator s(text.begin(), text.end(), section), end; s != end; ++s) {
    const auto from = static_cast<std::size_t>(s->position() + s->length());
    const std::string body = text.substr(from - 1, text.find("\n## ", from) - from + 1);
    const std::string name = (*s)[2], suffix = (*s)[3].matched ? ".steel" : "";
    const std::string header = (*s)[1] == "[[" ? "[[" + name + "]]" : "[" + name + suffix + "]";
    const auto check = [&](const std::string& table, const std::string& list) {
      for (std::sregex_iterator k(list.begin(), list.end(), key); k != end; ++k, ++keys) {
        expect_known(table, (*k)[1]);
      }
    };
    for (std::sregex_iterator r(body.begin(), body.end(), row); r != end; ++r)
      check(header, (*r)[1]);
    const std::string choice = name == "bearing" ? "kind" : "law";
    for (auto at = body.cbegin(); true; ++members[name]) {
      std::smatch found;
      if (!std::regex_search(at, body.cend(), found, member)) break;
      check(header + "\n" + choice + " = \"" + std::string(found[1]) + "\"", found[2]);
      at = found[0].second;
    }
  }
  EXPECT_GT(keys, 60);
  EXPECT_EQ(members["contact"], std::variant_size_v<AnyContactLaw<>>);
  EXPECT_EQ(members["bearing"], std::variant_size_v<AnyBearing>);
}

}  // namespace whirl::manual_test
