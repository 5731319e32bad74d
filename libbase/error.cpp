#include "libbase/error.hpp"

#include <utility>

namespace whirl::inline base {

std::string describe(const Problem& problem) {
  std::string text = problem.where.file;
  if (problem.where.line > 0) {
    text += ":" + std::to_string(problem.where.line) + ":" + std::to_string(problem.where.column);
  }
  if (!text.empty()) text += ": ";
  if (!problem.key.empty()) text += problem.key + ": ";
  return text + problem.message;
}

namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + describe(problem);
  return text;
}

}  // namespace

ModelError::ModelError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

ModelError::ModelError(Where where, std::string key, std::string message)
    : ModelError(std::vector<Problem>{{std::move(where), std::move(key), std::move(message)}}) {}

}  // namespace whirl::inline base
