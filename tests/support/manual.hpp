#pragma once
// The manual of the command line, whose pages tests compare with the program.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace whirl::test {

/// Its pages, one after the other.
inline std::string command_line_manual() {
  std::string text;
  for (const char* page : {"command-line", "options", "analyses", "lateral", "json", "result-file",
                           "result-motions", "result-studies", "figures", "programs"}) {
    std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs" /
                       (page + std::string(".md")));
    text.append(std::istreambuf_iterator<char>(file), {});
    text += '\n';
  }
  return text;
}

}  // namespace whirl::test
