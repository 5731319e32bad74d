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
  Flag force{"force", "replace files that whirl did not write, too"};
  Flag quiet = quiet_flag();
  auto fields() { return std::tie(out, json, threads, force, quiet); }
};

/// One call of the program.
class Invocation {
 public:
  std::string verb;
  std::string file;                      ///< model or result
  std::vector<std::string> words;        ///< after the file, of verbs that take more
  std::vector<std::string> sets;         ///< PATH=VALUE lines, --speed included
  std::vector<std::string> sets_before;  ///< those that model_text has in it already
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
  /// A result with the motion that this call would integrate, of verbs that can take it from there.
  std::string motion{};

  /// What is given of an option that several verbs have, for what all verbs do alike.
  std::vector<std::string> values(std::string_view option) const;
  /// The same of one that is given once; empty: it is not.
  std::string text(std::string_view option) const;

  /// The model; where processes share the work, that of their leader. Asked once.
  /// @throws ModelError, FileError  if it cannot be read, or is stored and starts from another file
  Model model() const;

  /// Its parts, to be stored in results.
  Call parts() const;

  /// What results may take the place of, and what pictures, pages and other files may.
  Replaces result_replaces() const;
  Replaces picture_replaces() const;

  /// The part of a study that it computes.
  /// @throws ModelError  as stripe_named
  Stripe stripe() const;
  /// The file of --out, or of this part of it; empty: none.
  std::string out_file() const;

  /// Whether somebody wants what a result file holds.
  bool wants_result() const { return output.out.is_given || kept; }
  /// Whether somebody looks at the record of its report, which of many points is large.
  bool wants_record() const { return output.json.is_given || kept; }
  /// The file of --out, and what is kept beside it, with the facts of this call in it; or nothing.
  std::unique_ptr<ResultWriter> result_file(const Model& model) const;
  /// Only what is kept, likewise.
  std::unique_ptr<ResultWriter> kept_file(const Model& model) const;
  /// Only the file, likewise.
  std::unique_ptr<ResultWriter> saved_file(const Model& model) const;

  /// Reads the options that all verbs have, and adopts what they say for the whole process.
  /// @throws ModelError, FileError  for a wrong one, and for places where nothing may be written: a
  ///                                file
  ///         that is read or needed, another output, an ending that says another format, another
  ///         call's
  void prepare();
  /// Tells whether to stop. Where nobody else is asked, Ctrl-C asks for it from now on.
  std::function<bool()> stop_asked() const;

 private:
  /// A stored model opens nothing by itself.
  /// @throws FileError  if it would, its motion starting from a file that this call does not name
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
  /// What the numbers leave out or go beyond, a sentence each: printed below the text, in JSON.
  std::vector<std::string> notes{};
  Failure failure;                 ///< goes to standard error, --quiet or not
  int status = exit_status::done;  ///< or failed or stopped: what was computed is in the report

  void add_notes(const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  }
};

}  // namespace whirl::inline cli
