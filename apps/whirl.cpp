// The program: command line in, reports out. The only file that sees CLI11.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "apps/bare_speeds.hpp"
#include "apps/completion.hpp"
#include "apps/invocation.hpp"
#include "apps/problems.hpp"
#include "apps/verb.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libio/model/model_schema.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/terminal.hpp"

namespace {

using namespace whirl;

enum Status { done = 0, wrong_input = 2, failed = 3 };

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
  return wrong_input;
}

/// What is wrong with words that CLI11 could not place: an unknown option, or a second file.
std::string misplaced(const CLI::App& app, const std::vector<std::string>& words,
                      const CLI::ParseError& error) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (!word.starts_with("--") || word == "--" ||
        std::find(known.begin(), known.end(), word) != known.end())
      continue;
    const auto near = nearest(word, known);
    return fmt::format("there is no option \"{}\"{}", word,
                       near ? fmt::format("; did you mean \"{}\"?", *near) : "");
  }
  std::string what = error.what();
  if (!app.remaining().empty())
    what = fmt::format("cannot place \"{}\"", fmt::join(app.remaining(), " "));
  return what;
}

/// Notes as they stand below a verb's text.
std::string notes_text(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += fmt::format("\n  note: {}\n", note);
  return text;
}

void write_json(const Report& report, const std::string& to, Replaces replaces) {
  Record record = report.record, notes = Record::array();
  for (const std::string& note : report.notes) notes.add(note);
  record.set("notes", notes);
  record.set(json_mark_key, json_mark);
  const std::string text = record.json();
  if (to == "-") {
    std::fputs(text.c_str(), stdout);
  } else {
    replace_file(to, text, replaces);
  }
}

void tell_taken(const TakenPlace& error) {
  fmt::print(stderr, "whirl: {}; take another name, or --force to replace it\n", error.what());
}

/// A status, unless what was printed did not arrive, on a full disk for instance.
int after_printing(int status) {
  if (std::fflush(stdout) == 0) return status;
  fmt::print(stderr, "whirl: cannot write to standard output\n");
  return wrong_input;
}

/// A model with what was set of it, of a result whose command is run again.
struct StoredModel {
  std::string text;  ///< empty: there is none
  std::vector<std::string> sets{};
};

int run(const std::vector<std::string>& words, const StoredModel& stored) {
  CLI::App app("whirl");
  app.set_help_flag();
  app.allow_windows_style_options(false);
  Invocation call;
  call.line = words;
  call.model_text = stored.text;
  call.sets_before = stored.sets;
  std::vector<std::string> sets;
  std::map<std::string, std::string> values;
  std::map<std::string, bool> flags;

  const std::string word = words.size() > 1 ? words[1] : "";
  const Verb* const verb = verb_named(word);
  if (!verb) return unknown_verb(word);
  call.verb = word;

  app.name("whirl " + word);
  app.description(fmt::format("{}\n\nExample: {}", verb->summary, verb->example));
  app.set_help_flag("-h,--help", "this help");
  app.add_option(std::string(verb->takes), call.file,
                 verb->takes == "MODEL"       ? "model file (TOML)"
                 : verb->takes == "RESULT.h5" ? "result file (HDF5)"
                                              : "result file (HDF5) or model file (TOML)")
      ->type_name("")
      ->required();
  if (!verb->takes_more.empty()) {
    app.add_option(std::string(verb->takes_more), call.words, std::string(verb->takes_more_help))
        ->type_name("");
  }
  for (const OptionSpec& option : options_of(*verb)) {
    const std::string name(option.name), dashed = "--" + name, help = help_of(option);
    if (name == "set" || name == "over") {
      app.add_option(dashed, name == "set" ? sets : call.over, help)
          ->type_name(std::string(option.value))
          ->take_all()
          ->expected(1);
    } else if (option.is_flag()) {
      app.add_flag(dashed, flags[name], help);
    } else {
      app.add_option(dashed, values[name], help)->type_name(std::string(option.value))->take_last();
    }
  }
  try {
    std::vector<std::string> arguments(words.rbegin(), words.rend() - 2);
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return done;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "whirl {}: {}\n(whirl {} --help shows its options)\n", word,
               misplaced(app, words, error), word);
    return wrong_input;
  }
  for (const auto& [name, value] : values) {
    if (name == "json" || name == "speed") continue;
    if (app.count("--" + name) > 0) call.given[name] = value;
  }
  for (const auto& [name, value] : flags) {
    if (value && name != "quiet") call.given[name] = "";
  }
  const std::string json = values["json"], speed = values["speed"];
  const bool quiet = flags["quiet"];
  if (app.count("--speed") > 0) sets.push_back("operation.speed=" + speed);
  call.sets = sets;
  call.shows_progress = !quiet;
  if (call.file.empty()) {
    fmt::print(stderr, "whirl {}: the name of the file is empty\n", word);
    return wrong_input;
  }

  try {
    if (call.has("threads")) call.integer("threads");
    call.require_free_places(json);
    const std::vector<BareSpeed> bare = bare_speeds(call, speed);
    if (!quiet) {
      for (const BareSpeed& s : bare) fmt::print(stderr, "whirl: warning: {}\n", s.warning());
    }
    Report report = verb->run(call);
    if (json != "-" && !quiet) {
      for (const BareSpeed& s : bare) fmt::print("{}\n", s.reading());
      fmt::print("{}{}", bare.empty() ? "" : "\n",
                 folded(report.text + notes_text(report.notes), terminal_columns()));
    }
    if (!report.failure.empty()) fmt::print(stderr, "{}: failed: {}\n", call.file, report.failure);
    for (const BareSpeed& s : bare) report.notes.push_back(s.warning());
    if (!json.empty()) write_json(report, json, call.picture_replaces());
    return after_printing(report.status);
  } catch (const ModelError& error) {
    print_problems(error, call, app.count("--speed") > 0 ? &speed : nullptr);
    return wrong_input;
  } catch (const TakenPlace& error) {
    tell_taken(error);
    return wrong_input;
  } catch (const FileError& error) {
    fmt::print(stderr, "whirl: {}\n", error.what());
    return wrong_input;
  } catch (const NumericalError& error) {
    fmt::print(stderr, "{}: {}\n", call.file, error.what());
    return failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}: not enough memory for this\n", call.file);
    return failed;
  }
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
    fmt::print(stderr, "whirl: {}\n", error.what());
    return wrong_input;
  }
  const Verb* const verb = verb_named(call.verb);
  if (!verb || verb->takes != "MODEL" || call.file.empty() || call.file.starts_with('-')) {
    fmt::print(stderr, "whirl: {} does not hold the command that made it\n", file);
    return wrong_input;
  }
  // what was set is in the stored text already, and only the line at hand says what is written
  std::vector<std::string_view> left_out{"quiet", "force", "restart"};
  left_out.insert(left_out.end(), writing_options.begin(), writing_options.end());
  std::vector<std::string> words{"whirl", call.verb, call.file};
  for (const std::string& option : options_without(call.options, left_out)) {
    words.push_back(option);
  }
  words.insert(words.end(), further.begin(), further.end());
  return run(words, {text, call.sets});
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
    return asks_help ? done : wrong_input;
  }
  const std::string text = model_schema().json();
  if (!has_file) {
    std::fputs(text.c_str(), stdout);
    return after_printing(done);
  }
  try {
    replace_file(options[1], text, is_forced ? Replaces::anything : Replaces::own_pictures);
  } catch (const TakenPlace& error) {
    tell_taken(error);
    return wrong_input;
  } catch (const FileError& error) {
    fmt::print(stderr, "whirl: {}\n", error.what());
    return wrong_input;
  }
  return done;
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
    return done;
  }
  if (word == "completion") {
    fmt::print("{}", bash_completion());
    return after_printing(done);
  }
  if (word == "--version") {
    fmt::print("whirl {}\n", version);
    return done;
  }
  try {
    if (word == "schema") return write_schema({words.begin() + 2, words.end()});
    if (word == "help" && words[2] == "schema") return write_schema({"--help"});
    if (word == "help") return run({words[0], words[2], "--help"}, {});
    if (word != "rerun") return run(words, {});
    if (words.size() < 3 || words[2] == "--help") {
      fmt::print(
          "Usage: whirl rerun RESULT.h5 [options]\n\nRuns the command that made a result again, on "
          "the model "
          "stored in it;\noptions are added to that command (--out NEW.h5, --set PATH=VALUE, "
          "...).\n");
      return words.size() < 3 ? wrong_input : done;
    }
    return rerun(words[2], {words.begin() + 3, words.end()});
  } catch (const std::exception& error) {
    std::fputs(fmt::format("whirl: {}\n", error.what()).c_str(), stderr);  // which may be full too
    return failed;
  }
}
