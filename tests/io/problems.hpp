#pragma once
// What is said about a wrong model.

#include <string>
#include <vector>

#include "libio/model/model_file.hpp"

namespace whirl::test {

/// All problems of a text, as people see them.
inline std::vector<std::string> problems(const std::string& text) {
  std::vector<std::string> all;
  try {
    parse_model(text, "m", {}, "");
  } catch (const ModelError& error) {
    for (const Problem& p : error.problems()) all.push_back(describe(p));
  }
  return all;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace whirl::test
