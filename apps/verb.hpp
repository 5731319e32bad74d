#pragma once
/// What a verb of the command line is: its options, and a function from an invocation to a report.

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/results/call.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/record.hpp"

namespace whirl {

class ResultWriter;

/// An option of a verb beside the common ones.
struct OptionSpec {
  std::string_view name;   ///< without dashes
  std::string_view value;  ///< placeholder of its value; empty: a flag
  std::string_view help;
};

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
  /// Values of options; ModelError where they are not what they should be.
  std::string text(const std::string& option, const std::string& otherwise = "") const;
  long integer(const std::string& option, long otherwise, long least = 1) const;
  double number(const std::string& option, std::string_view unit, double otherwise) const;
  /// --speeds, or from zero to somewhat above the operating speed.
  std::vector<double> speeds(const Model& model) const;

  Model model() const;

  /// Its parts, to be stored in results.
  Call parts() const;

  /// What results may take the place of, and what pictures, pages and other files may.
  Replaces result_replaces() const;
  Replaces picture_replaces() const;

  /// Checks that results take the place of nothing but results, before the work.
  /// @param json  value of --json
  /// @throws FileError  naming what would be lost: the model, another file, the other result
  void require_free_places(const std::string& json) const;

  /// The file of --out with the facts of this call in it, or nothing.
  std::unique_ptr<ResultWriter> result_file(const Model& model) const;
};

/// What a verb found.
struct Report {
  Record record;     ///< for --json, without the entries that all verbs have
  std::string text;  ///< for people
  /// What the numbers leave out or go beyond, a sentence each: printed below the text, in JSON.
  std::vector<std::string> notes{};
  std::string failure;  ///< goes to standard error, --quiet or not
  int status = 0;       ///< 0; 3: failed, what was computed is in the report; 130: stopped
};

struct Verb {
  std::string_view name;
  std::string_view group;  ///< heading in the help
  std::string_view summary;
  std::string_view takes;    ///< MODEL or RESULT.h5
  std::string_view example;  ///< a command line
  std::vector<OptionSpec> options;
  Report (*run)(const Invocation&);
  std::string_view takes_more = "";       ///< placeholder of words after the file; empty: none
  std::string_view takes_more_help = "";  ///< what they are
};

/// Options that name a place to write.
constexpr std::array<std::string_view, 3> writing_options{"out", "json", "svg"};

/// All verbs, in the order of the help.
const std::vector<Verb>& verbs();
/// The one of a name; null: there is none.
const Verb* verb_named(std::string_view name);

/// From now on the first Ctrl-C asks to stop, and the second one ends the program as usual.
void install_interrupt_handler();
/// Whether it did; long work looks at it and stops with what it has.
bool is_interrupted();

/// A line on standard error that is rewritten while something long goes on; only on a terminal.
class Progress {
 public:
  Progress(std::string what, long total, bool shows);
  ~Progress();
  /// Redraws at most ten times a second.
  void update(long done);

 private:
  std::string what_;
  long total_;
  bool shows_;
  double begin_, last_ = 0.0;
  bool has_drawn_ = false;
};

}  // namespace whirl
