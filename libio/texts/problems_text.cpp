#include "apps/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace whirl::inline cli {

namespace {

/// The part of a line around a column that fits a terminal, and the column in that part.
std::pair<std::string, int> excerpt(const std::string& line, int column) {
  constexpr int most = 100, before = 60;
  std::vector<std::string> signs;  // columns count characters, not bytes
  for (const char c : line) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
    if (continues && !signs.empty()) {
      signs.back() += c;
    } else {
      signs.emplace_back(1, static_cast<unsigned char>(c) < ' ' ? ' ' : c);
    }
  }
  const int size = static_cast<int>(signs.size());
  column = std::clamp(column, 1, size + 1);
  const int from = size <= most ? 0 : std::max(0, column - 1 - before);
  const int to = std::min(size, from + most);
  std::string text = from > 0 ? "…" : "";
  for (int i = from; i < to; ++i) text += signs[static_cast<std::size_t>(i)];
  return {text + (to < size ? "…" : ""), column - from + (from > 0 ? 1 : 0)};
}

/// Lines of files, each read once.
class Lines {
 public:
  explicit Lines(const Invocation& call) : call_(call) {}

  const std::vector<std::string>& of(const std::string& name) {
    const auto known = texts_.find(name);
    if (known != texts_.end()) return known->second;
    std::vector<std::string> lines;
    std::istringstream stored(call_.model_text);
    std::ifstream file(name);
    const bool is_stored = name == call_.file && !call_.model_text.empty();
    std::istream& from = is_stored ? stored : static_cast<std::istream&>(file);
    for (std::string line; std::getline(from, line);) lines.push_back(line);
    if (!lines.empty() && lines[0].starts_with("\x89HDF")) {
      lines.clear();  // a result: nothing to show
    }
    return texts_[name] = lines;
  }

 private:
  const Invocation& call_;
  std::map<std::string, std::vector<std::string>> texts_;
};

}  // namespace

void print_problems(const ModelError& error, const Invocation& call, const std::string* speed) {
  Lines read(call);
  for (Problem problem : error.problems()) {
    if (problem.where.file.empty()) problem.where.file = call.file;
    if (speed && problem.where.file == "--set operation.speed=" + *speed) {
      problem.where.file = "--speed " + *speed;
      problem.key.clear();
    }
    fmt::print(stderr, "{}\n", describe(problem));
    const Where& w = problem.where;
    if (w.line <= 0) continue;
    const auto& lines = read.of(w.file);
    if (static_cast<std::size_t>(w.line) > lines.size()) continue;
    const auto [text, column] = excerpt(lines[static_cast<std::size_t>(w.line - 1)], w.column);
    fmt::print(stderr, "{:>5} | {}\n      | {:>{}}\n", w.line, text, "^", column);
  }
}

}  // namespace whirl::inline cli
