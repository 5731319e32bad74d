// A broken model file ends in a model or in an error, never in anything else: mutations of the
// bundled models, the same ones every time.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::mutation_test {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t n) {
  return random() % n;  // the same on every platform, unlike the distributions of <random>
}

std::string flip_bytes(const std::string& original, Random& random) {
  std::string text = original;
  for (std::size_t i = 0, n = 1 + below(random, 4); i < n; ++i) {
    text[below(random, text.size())] = static_cast<char>(below(random, 256));
  }
  return text;
}

/// Changes single characters into ones that mean something in TOML and in quantities.
std::string change_signs(const std::string& original, Random& random) {
  std::string text = original;
  const std::string signs = "[]{}\"'=,.#-+^/*e0 9\n\\";
  for (std::size_t i = 0, n = 1 + below(random, 4); i < n; ++i) {
    text[below(random, text.size())] = signs[below(random, signs.size())];
  }
  return text;
}

std::string cut_off(const std::string& text, Random& random) {
  return text.substr(0, below(random, text.size()));
}

std::string edit_lines(const std::string& text, Random& random) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (std::size_t i = 0, n = 1 + below(random, 3); i < n; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(below(random, lines.size()));
    const std::string line = lines[static_cast<std::size_t>(at)];
    switch (below(random, 3)) {
      case 0:
        lines.erase(lines.begin() + at);
        break;
      case 1:
        lines.insert(lines.begin() + at, line);
        break;
      default:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(random, lines.size())),
                     line);
    }
  }
  std::string joined;
  for (const std::string& line : lines) joined += line + "\n";
  return joined;
}

/// Puts another value into a key.
std::string change_value(const std::string& text, Random& random) {
  const std::vector<std::string> values = {"0",
                                           "-1",
                                           "1e308",
                                           "nan",
                                           "inf",
                                           "true",
                                           "\"\"",
                                           "\"1\"",
                                           "\"9e999 m\"",
                                           "[]",
                                           "{}",
                                           "\"-0\"",
                                           "[1,2]",
                                           "1979-05-27",
                                           "\"mm\"",
                                           "[[[1]]]",
                                           "\"ground\"",
                                           "{ xx = 1 }",
                                           "9223372036854775807"};
  std::vector<std::size_t> signs;
  for (auto at = text.find("= "); at != std::string::npos; at = text.find("= ", at + 1)) {
    signs.push_back(at);
  }
  const std::size_t at = signs[below(random, signs.size())] + 2;
  return text.substr(0, at) + values[below(random, values.size())] +
         text.substr(text.find('\n', at));
}

TEST(ModelFile, BrokenInAnyWayEndsInAModelOrAnError) {
  std::vector<std::string> models_there;
  for (const auto& entry : std::filesystem::directory_iterator(WHIRL_SOURCE_DIR "/models")) {
    if (entry.path().extension() != ".toml") continue;
    std::ifstream file(entry.path());
    models_there.emplace_back(std::istreambuf_iterator<char>(file),
                              std::istreambuf_iterator<char>());
  }
  std::sort(models_there.begin(), models_there.end());
  ASSERT_GE(models_there.size(), 10u);
  Random random(7);
  int models = 0, errors = 0;
  const auto mutations = {flip_bytes, change_signs, cut_off, edit_lines, change_value};
  for (const auto mutate : mutations) {
    for (int i = 0; i < 400; ++i) {
      try {
        const std::string& text = models_there[below(random, models_there.size())];
        parse_model(mutate(text, random), "mutation");
        ++models;
      } catch (const ModelError& error) {
        EXPECT_GT(std::string(error.what()).size(), 10u);
        ++errors;
      }
    }
  }
  EXPECT_GT(models, 100);  // in comments and titles anything goes
  EXPECT_GT(errors, 800);
}

}  // namespace whirl::mutation_test
