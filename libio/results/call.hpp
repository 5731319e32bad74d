#pragma once
/// The call of the program that made a result: its parts, to a result file and back, and as a line
/// for a shell.

#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline dyn {
struct Model;
}

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// The parts of a command line, as the program understood them.
struct Call {
  std::string verb;
  std::string file;                  ///< the model, or the result, that it is about
  std::vector<std::string> words{};  ///< after the file
  /// PATH=VALUE of the model, --speed among them; the stored model has them in it.
  std::vector<std::string> sets{};
  std::vector<std::string> options{};  ///< all others: "--discard=300", "--fresh"
};

/// "discard" of "--discard=300".
std::string option_name(std::string_view option);

/// The options with one of these names, or with none of them.
std::vector<std::string> options_named(const std::vector<std::string>& options,
                                       const std::vector<std::string_view>& names);
std::vector<std::string> options_without(const std::vector<std::string>& options,
                                         const std::vector<std::string_view>& names);

/// The words that make a call again on the model that is stored with it: its verb, its file, and
/// its options without those that do not count. What was set is in the stored model already.
/// @param left_out  options that do not count: only the line at hand says what is written
std::vector<std::string> words_again(const std::string& program, const Call& call,
                                     std::vector<std::string_view> left_out);

/// Takes a command line apart as early versions stored it: words, in any of the forms "--set X",
/// "--set=X". Where a value was given several times the last one holds, but of --set and --over
/// all.
/// @param words  program, verb, file and options
Call parse_call(const std::vector<std::string>& words);

/// Writes group /call of a result file.
void write_call(ResultWriter& file, const Call& call);

/// Reads group /call; of a file without that group, the words of the command line are taken apart.
/// @throws FileError  if the file holds neither group nor words
Call read_call(const ResultReader& file);

/// Where a result comes from.
struct ResultOrigin {
  Call call;
  std::vector<std::string> line;  ///< the words of the command line
  std::string_view version;       ///< of the program
};

/// Writes what every result file holds beside its results: its format, its origin, the time, and
/// the model as it was.
void write_origin(ResultWriter& file, const ResultOrigin& origin, const Model& model);

/// The model that a result was computed of, as write_origin stored it.
/// @throws FileError  if the file has none
std::string stored_model(const ResultReader& file);

/// A word in quotation marks if needed, so that a shell takes it for one word, whatever is in it.
std::string shell_word(std::string_view word);

/// Words as a line for a shell.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace whirl::inline io
