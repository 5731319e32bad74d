// The program: finds the verb of a command line and runs it.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "apps/command.hpp"
#include "apps/completion.hpp"
#include "apps/status.hpp"
#include "apps/verb.hpp"
#include "apps/version.hpp"
#include "libio/model/model_schema.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/nearest.hpp"

namespace {

using namespace whirl;

/// Help of the whole program: verbs by group, an example each.
std::string overview() {
  std::string text =
      "whirl: rotordynamics with contact\n\n"
      "Usage: whirl VERB MODEL [options]\n\n";
  std::string_view group;
  for (const Verb& verb : verbs()) {
    if (verb.group != group) text += fmt::format("{}{}\n", group.empty() ? "" : "\n", verb.group);
    group = verb.group;
    text += fmt::format("  {:<10} {}\n             {}\n", verb.name, verb.summary, verb.example);
  }
  text += fmt::format("  {:<10} {}\n             {}\n", "rerun",
                      "runs the command that made a result again", "whirl rerun run.h5");
  text += fmt::format("  {:<10} {}\n             {}\n", "completion",
                      "a script that completes verbs and options in bash",
                      "source <(whirl completion)");
  text += fmt::format("  {:<10} {}\n             {}\n", "schema",
                      "a JSON Schema of model files, for editors",
                      "whirl schema --out whirl.schema.json");
  return text +
         "\nCommon options: --set PATH=VALUE, --speed S, --out FILE.h5, --json FILE, --threads N, "
         "--force, --quiet\n"
         "More: whirl VERB --help, docs/command-line.md, docs/model-file.md\n";
}

/// A verb that does not exist, with the nearest one.
int unknown_verb(const std::string& word) {
  std::vector<std::string> known;
  for (const Verb& verb : verbs()) known.emplace_back(verb.name);
  for (const char* other : {"rerun", "completion", "schema", "--help", "--version"})
    known.emplace_back(other);
  const auto near = nearest(word, known);
  fmt::print(stderr, "whirl: there is no {} \"{}\"; {}\n",
             word.starts_with('-') ? "option" : "verb", word,
             near ? fmt::format("did you mean \"{}\"?", *near)
                  : fmt::format("known are {}", fmt::join(known, ", ")));
  return exit_status::wrong_input;
}

int run(const std::vector<std::string>& words) {
  const Verb* const verb = verb_named(words[1]);
  return verb ? run_command(*verb, words) : unknown_verb(words[1]);
}

/// Runs the command stored in a result again, on the model stored there.
int rerun(const std::string& file, std::vector<std::string> further) {
  Call call;
  std::string text;
  try {
    const ResultReader result(file);
    call = read_call(result);
    text = result.strings("/model").at(0);
  } catch (const FileError& error) {
    return refused(error);
  }
  const Verb* const verb = verb_named(call.verb);
  if (!verb || verb->takes != "MODEL" || call.file.empty() || call.file.starts_with('-')) {
    fmt::print(stderr, "whirl: {} does not hold the command that made it\n", file);
    return exit_status::wrong_input;
  }
  // what was set is in the stored text already, and only the line at hand says what is written
  std::vector<std::string_view> left_out{"quiet", "force", "restart"};
  left_out.insert(left_out.end(), writing_options.begin(), writing_options.end());
  std::vector<std::string> words{"whirl", call.verb, call.file};
  for (const std::string& option : options_without(call.options, left_out)) {
    words.push_back(option);
  }
  words.insert(words.end(), further.begin(), further.end());
  return run_command(*verb, words, {text, call.sets});
}

/// The schema of model files, to a file or to standard output.
int write_schema(const std::vector<std::string>& options) {
  const bool is_forced = options.size() == 3 && options[2] == "--force";
  const bool has_file = (options.size() == 2 || is_forced) && options[0] == "--out";
  const bool asks_help = options == std::vector<std::string>{"--help"};
  if (asks_help || (!options.empty() && !has_file)) {
    fmt::print(
        asks_help ? stdout : stderr,
        "Usage: whirl schema [--out FILE.json [--force]]\n\nWrites a JSON Schema of model files. "
        "An "
        "editor that knows TOML completes and checks\nkeys with it; in a model's first line: "
        "#:schema ./FILE.json\n");
    return asks_help ? exit_status::done : exit_status::wrong_input;
  }
  const std::string text = model_schema().json();
  if (!has_file) {
    std::fputs(text.c_str(), stdout);
    return after_printing(exit_status::done);
  }
  try {
    replace_file(options[1], text, is_forced ? Replaces::anything : Replaces::own_pictures);
  } catch (const TakenPlace& error) {
    return refused(error);
  } catch (const FileError& error) {
    return refused(error);
  }
  return exit_status::done;
}

/// Takes the places of standard streams that are closed: or else a result file would get the number of
/// one, and what is printed there would end in it. To what is not there nothing can be printed.
void fill_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    (void)::open("/dev/null",
                 stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // the lowest free one
  }
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  const std::vector<std::string> words(argv, argv + argc);
  const std::string word = words.size() > 1 ? words[1] : "--help";
  if (word == "--help" || word == "-h" || (word == "help" && words.size() == 2)) {
    fmt::print("{}", overview());
    return exit_status::done;
  }
  if (word == "completion") {
    fmt::print("{}", bash_completion());
    return after_printing(exit_status::done);
  }
  if (word == "--version") {
    fmt::print("whirl {}\n", version);
    return exit_status::done;
  }
  try {
    if (word == "schema") return write_schema({words.begin() + 2, words.end()});
    if (word == "help" && words[2] == "schema") return write_schema({"--help"});
    if (word == "help") return run({words[0], words[2], "--help"});
    if (word != "rerun") return run(words);
    if (words.size() < 3 || words[2] == "--help") {
      fmt::print(
          "Usage: whirl rerun RESULT.h5 [options]\n\nRuns the command that made a result again, on "
          "the model "
          "stored in it;\noptions are added to that command (--out NEW.h5, --set PATH=VALUE, "
          "...).\n");
      return words.size() < 3 ? exit_status::wrong_input : exit_status::done;
    }
    return rerun(words[2], {words.begin() + 3, words.end()});
  } catch (const std::exception& error) {
    std::fputs(fmt::format("whirl: {}\n", error.what()).c_str(), stderr);  // which may be full too
    return exit_status::failed;
  }
}
