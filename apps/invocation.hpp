#pragma once
/// One call of a verb, and what comes of it.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/system/model.hpp"
#include "libio/results/call.hpp"
#include "libio/results/command_files.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {
class ResultWriter;
}

namespace whirl::inline cli {

/// One call of the program.
class Invocation {
 public:
  std::string verb;
  std::string file;                          ///< model or result
  std::vector<std::string> words;            ///< after the file, of verbs that take more
  std::vector<std::string> sets;             ///< PATH=VALUE lines, --speed included
  std::vector<std::string> sets_before;      ///< those that model_text has in it already
  std::vector<std::string> over;             ///< values of --over, which may be given several times
  std::map<std::string, std::string> given;  ///< options and their values; flags have an empty one
  std::vector<std::string> line;             ///< the command line, to be stored in results
  std::string model_text;                    ///< of a result that is run again; else empty
  bool shows_progress = false;

  bool has(const std::string& option) const { return given.count(option) > 0; }

  /// Value of an option; where it is left out, its default as the verb states it, or "".
  std::string text(const std::string& option) const;
  /// An option that means nothing, with its value.
  /// @param problem  what would be right
  ModelError wrong(const std::string& option, std::string problem) const;
  /// Value of an option as a function reads it that gives a Parsed.
  /// @throws ModelError  naming the option, if it means nothing
  template <class Parse>
  auto parsed(const std::string& option, const Parse& parse) const {
    return parsed_option(option, text(option), parse);
  }
  /// Value of an option as a number; without a default, the option must be given.
  /// @throws ModelError  naming the option, if it is none, or smaller than the least
  long integer(const std::string& option, long least = 1) const;
  double number(const std::string& option, std::string_view unit) const;

  /// The same of options whose default the model or other options decide, as the help says.
  std::string text_or(const std::string& option, const std::string& otherwise) const;
  long integer_or(const std::string& option, long otherwise, long least = 1) const;

  /// --speeds, or from zero to somewhat above the operating speed.
  std::vector<double> speeds(const Model& model) const;

  Model model() const;

  /// Its parts, to be stored in results.
  Call parts() const;

  /// What results may take the place of, and what pictures, pages and other files may.
  Replaces result_replaces() const;
  Replaces picture_replaces() const;

  /// The files that it reads and writes.
  /// @param json  value of --json
  CommandFiles files(const std::string& json) const;

  /// The file of --out with the facts of this call in it, or nothing.
  std::unique_ptr<ResultWriter> result_file(const Model& model) const;
};

/// What a verb found.
struct Report {
  Record record;     ///< for --json, without the entries that all verbs have
  std::string text;  ///< for people
  /// What the numbers leave out or go beyond, a sentence each: printed below the text, in JSON.
  std::vector<std::string> notes{};
  Failure failure;  ///< goes to standard error, --quiet or not
  int status = 0;   ///< 0; 3: failed, what was computed is in the report; 130: stopped

  void add_notes(const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  }
};

}  // namespace whirl::inline cli
