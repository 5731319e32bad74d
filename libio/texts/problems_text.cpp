#include "libio/texts/problems_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "libio/text/file_bytes.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

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
  explicit Lines(const ProblemSource& source) : source_(source) {}

  const std::vector<std::string>& of(const std::string& name) {
    const auto known = texts_.find(name);
    if (known != texts_.end()) return known->second;
    std::vector<std::string> lines;
    const bool is_stored = name == source_.file && !source_.stored_text.empty();
    std::string text = source_.stored_text;
    if (!is_stored) text = file_bytes(name, FileKind::regular, most_text_bytes).value.value_or("");
    if (text.starts_with("\x89HDF")) text.clear();  // a result: nothing to show
    std::istringstream from(text);
    for (std::string line; std::getline(from, line);) lines.push_back(line);
    return texts_[name] = lines;
  }

 private:
  const ProblemSource& source_;
  std::map<std::string, std::vector<std::string>> texts_;
};

}  // namespace

std::string problems_text(const ModelError& error, const ProblemSource& source) {
  Lines read(source);
  std::string all;
  for (Problem problem : error.problems()) {
    if (problem.where.file.empty()) problem.where.file = source.file;
    all += describe(problem) + "\n";
    const Where& w = problem.where;
    if (w.line <= 0) continue;
    const auto& lines = read.of(w.file);
    if (static_cast<std::size_t>(w.line) > lines.size()) continue;
    const auto [text, column] = excerpt(lines[static_cast<std::size_t>(w.line - 1)], w.column);
    all += fmt::format("{:>5} | {}\n      | {:>{}}\n", w.line, text, "^", column);
  }
  return all;
}

ModelError renamed(const ModelError& error, const std::string& from, const std::string& to) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    if (problem.where.file != from) continue;
    problem.where.file = to;
    problem.key.clear();
  }
  return ModelError(std::move(problems));
}

ModelError under_over(const ModelError& error, const std::vector<std::string>& over,
                      const std::vector<std::string>& sets) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    const std::string& path = problem.where.set;
    const bool is_set = std::any_of(sets.begin(), sets.end(), [&](const std::string& set) {
      return problem.where.file == "--set " + set;
    });
    if (is_set || path.empty()) continue;
    const auto of = std::find_if(over.begin(), over.end(), [&](const std::string& one) {
      return ParameterAxis{.path = one.substr(0, one.find('='))}.has(path);
    });
    if (of != over.end()) problem.where.file = "--over " + *of;
  }
  return ModelError(std::move(problems));
}

std::string warnings_text(const std::vector<Problem>& doubts) {
  if (doubts.empty()) return "\n  The model is in order.\n";
  std::string text =
      fmt::format("\n  The model can be read, but there {}:\n",
                  doubts.size() == 1 ? std::string("is a warning")
                                     : fmt::format("are {} warnings", doubts.size()));
  for (const Problem& doubt : doubts) text += "\n  warning: " + describe(doubt) + "\n";
  return text;
}

Record record_of_problems(const std::vector<Problem>& problems) {
  Record all = Record::array();
  for (const Problem& problem : problems) {
    Record one;
    one.set("file", problem.where.file).set("line", problem.where.line);
    one.set("column", problem.where.column).set("key", problem.key);
    all.add(one.set("message", problem.message));
  }
  return all;
}

}  // namespace whirl::inline io
