#pragma once
/// What can go wrong: a wrong model (ModelError) or failed mathematics (NumericalError).

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace whirl::inline base {

/// Place in an input: a file's name (or the command line's words), line and column from 1.
struct Where {
  std::string file;
  int line = 0;  ///< 0: no place within the file
  int column = 0;
  std::string set = {};  ///< path of the value, where a command line sets one; else empty

  bool operator==(const Where&) const = default;
};

/// One thing that is wrong in a model, in words for the person who wrote it.
struct Problem {
  Where where;
  std::string key;      ///< path of the entry, such as contact.seal.stiffness; may be empty
  std::string message;  ///< what was found and what would be right
};

/// "file:line:column: key: message", with the parts that are known.
std::string describe(const Problem& problem);

/// The model is wrong. Carries every problem that was found, in the order of the file.
class ModelError : public std::runtime_error {
 public:
  explicit ModelError(std::vector<Problem> problems);
  ModelError(Where where, std::string key, std::string message);

  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// An option of an analysis means nothing; the message says which option and what would be right.
class OptionError : public ModelError {
 public:
  explicit OptionError(std::string message) : OptionError("", std::move(message)) {}
  /// @param option  name of the option, in words with hyphens; the key of the problem
  OptionError(std::string option, std::string message)
      : ModelError({}, option, std::move(message)), option_(std::move(option)) {}

  const std::string& option() const { return option_; }  ///< empty: the message names the option

 private:
  std::string option_;
};

/// The model is well-formed, but a computation on it failed; the message says what was tried.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whirl::inline base
