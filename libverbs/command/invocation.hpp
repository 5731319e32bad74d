#pragma once
/// One call of a verb, and what comes of it.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/processes/ranks.hpp"
#include "libdyn/system/model.hpp"
#include "libio/results/call.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/results/study_part.hpp"
#include "libio/text/option.hpp"
#include "libio/text/record.hpp"
#include "libverbs/command/exit_status.hpp"

namespace whirl::inline io {
class OutputLock;
class ResultWriter;
struct KeptResult;
}  // namespace whirl::inline io

namespace whirl::inline cli {

/// Options of all verbs, before their own.
struct ModelOptions {
  ListOption sets{"set", "PATH=VALUE",
                  "set a value of the model by its path; may be given several times"};
  Option<std::string> speed{"speed", "S", "operating speed, such as 3650rpm"};
  auto fields() { return std::tie(sets, speed); }
};

inline Option<std::string> json_option() {
  return output_option("json", "FILE", "write the result as JSON; - is standard output",
                       ".json .txt -");
}
inline Flag quiet_flag() {
  return {"quiet", "print nothing but errors"};
}

/// Options of all verbs, behind their own.
struct OutputOptions {
  Option<std::string> out = output_option("out", "FILE.h5", "result file (HDF5)", ".h5 .hdf5");
  Option<std::string> json = json_option();
  Option<long> threads{"threads", "N", "processors to use at most; left out: all that it may use",
                       Whole{1, 1024}};
  Option<std::string> units{
      "units", "LIST",
      "that numbers are shown in: us, si, cgs, file (the model's), none, or units such as "
      "rad/s,kN; "
      "left out: the model's [report] units, or WHIRL_UNITS, else si; files and JSON are SI"};
  Flag force{"force", "replace files that whirl did not write, too"};
  Flag quiet = quiet_flag();
  auto fields() { return std::tie(out, json, threads, units, force, quiet); }
};

/// What a call is given, by a command line or a program.
struct CallInput {
  std::string verb;
  std::string file;                      ///< model or result
  std::vector<std::string> words;        ///< after the file, of verbs that take more
  std::vector<std::string> sets;         ///< PATH=VALUE lines, --speed included
  std::vector<std::string> sets_before;  ///< sets that model_text has in it already
  GivenValues given;                     ///< all options, from which those of the verb are read
  OutputOptions output;
  std::vector<std::string> line;  ///< the command line, to be stored in results
  std::string model_text;         ///< of a result that is run again; else empty
  const Ranks* ranks = nullptr;   ///< processes that share its work; null: there are none
  /// Files that a study takes its points from, instead of computing any.
  std::optional<std::vector<std::string>> joins;

  // of a program that calls verbs itself; left out, they are for a terminal
  std::shared_ptr<const Model> made;  ///< the model, if there is one already
  KeptResult* kept = nullptr;         ///< takes what the file of --out holds
  std::function<void(const std::string& what, long done, long total)> progress{};
  std::function<bool()> is_stopped{};
  /// A result with the motion that this call would integrate, for verbs that can take a motion from
  /// a result.
  std::string motion{};
};

/// One call of the program.
class Invocation : public CallInput {
 public:
  /// Values that are given of an option, by its name: for what several verbs do alike.
  std::vector<std::string> values(std::string_view option) const;
  /// The value of an option that is given once; empty: not given.
  std::string text(std::string_view option) const;

  /// The model; where processes share the work, the model of their leader. To be called once.
  /// @throws ModelError, FileError  if it cannot be read, or is stored and starts from another file
  Model model() const;

  /// The same model with more PATH=VALUE lines, read once more.
  Model variant(const std::vector<std::string>& more) const;

  /// The parts of this call, to be stored in results.
  Call parts() const;

  /// What results may take the place of, and what pictures, pages and other files may.
  Replaces result_replaces() const;
  Replaces picture_replaces() const;

  /// The part of a study that this call computes.
  /// @throws ModelError  as stripe_named
  Stripe stripe() const;
  /// The file of --out, or the file of this part of a study; empty: none.
  std::string out_file() const;

  /// Whether somebody wants what a result file holds.
  bool wants_result() const { return output.out.is_given || kept; }
  /// Whether somebody wants the record of the report, which is large for many points.
  bool wants_record() const { return output.json.is_given || kept; }
  /// The file of --out, and what is kept beside it, with the facts of this call in it; or nothing.
  std::unique_ptr<ResultWriter> result_file(const Model& model) const;
  /// Only what is kept, with the facts of this call in it; or nothing.
  std::unique_ptr<ResultWriter> kept_file(const Model& model) const;
  /// Only the file of --out, with the facts of this call in it; or nothing.
  std::unique_ptr<ResultWriter> saved_file(const Model& model) const;

  /// Reads the options that all verbs have, and adopts what they say for the whole process.
  /// @throws ModelError, FileError  for a wrong option, and for places where nothing may be
  ///                                written: a file that is read or needed, another output, an
  ///                                ending that says another format, an output of another call
  void prepare();
  /// A function that tells whether to stop. Without is_stopped, Ctrl-C asks to stop from now on.
  std::function<bool()> stop_asked() const;
  /// Shows numbers in the units that this call asks for, else in those of WHIRL_UNITS.
  /// @param model  text of the model that is shown
  /// @throws ModelError  for units that are not known
  void adopt_units(const std::string& model) const;

 private:
  /// Checks that a stored model opens no file by itself.
  /// @throws FileError  if its motion starts from a file that this call does not name
  void require_said_start(const Model& model) const;
  void note_read_files() const;
  void note_written_files();
  std::unique_ptr<ResultWriter> begun(std::unique_ptr<ResultWriter> to, const Model& model) const;

  std::vector<std::shared_ptr<const OutputLock>> locks_{};  ///< of the outputs, until the call ends
};

/// What a verb found.
struct Report {
  Record record;     ///< for --json, without the entries that all verbs have
  std::string text;  ///< for people
  /// What the numbers leave out or go beyond, a sentence each: printed below the text, and in JSON.
  std::vector<std::string> notes{};
  Failure failure;                 ///< goes to standard error, --quiet or not
  int status = exit_status::done;  ///< or failed or stopped: what was computed is in the report

  void add_notes(const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  }
};

}  // namespace whirl::inline cli
