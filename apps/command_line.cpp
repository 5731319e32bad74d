// The only file that sees CLI11.

#include "apps/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <span>

#include "apps/program.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline cli {

namespace {

/// Places for the values of options, by their names.
struct Values {
  std::map<std::string, std::string> texts;
  std::map<std::string, bool> flags;
  std::map<std::string, std::vector<std::string>> lists;  ///< of options that may be repeated
};

std::string help_of_file(std::string_view takes) {
  if (takes == "MODEL") return "model file (TOML)";
  return takes == "RESULT.h5" ? "result file (HDF5)" : "result file (HDF5) or model file (TOML)";
}

/// Tells CLI11 the files and options of a verb, and where their values go.
void declare(const Verb& verb, CLI::App& app, Invocation& call, Values& values) {
  app.name(fmt::format("whirl {}", verb.name));
  app.description(fmt::format("{}{}\n\nExample: {}", verb.summary,
                              verb.alias.empty() ? "" : fmt::format("\nAlso: whirl {}", verb.alias),
                              verb.example));
  app.set_help_flag("-h,--help", "this help");
  app.allow_windows_style_options(false);
  app.add_option(std::string(verb.takes), call.file, help_of_file(verb.takes))
      ->type_name("")
      ->required();
  if (!verb.takes_more.empty()) {
    app.add_option(std::string(verb.takes_more), call.words, std::string(verb.takes_more_help))
        ->type_name("");
  }
  for (const OptionSpec& option : options_of(verb)) {
    const std::string name(option.name), dashed = "--" + name, help = help_of(option);
    if (name == "set" || name == "over") {
      app.add_option(dashed, values.lists[name], help)
          ->type_name(std::string(option.value))
          ->take_all()
          ->expected(1);
    } else if (option.is_flag()) {
      app.add_flag(dashed, values.flags[name], help);
    } else {
      app.add_option(dashed, values.texts[name], help)
          ->type_name(std::string(option.value))
          ->take_last();
    }
  }
}

/// What is wrong with words that CLI11 could not place: an unknown option, or a second file.
std::string misplaced(const CLI::App& app, const std::vector<std::string>& words,
                      const CLI::ParseError& error) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  if (const auto unknown = unknown_option(std::span(words).subspan(2), known)) return *unknown;
  if (app.remaining().empty()) return error.what();
  return fmt::format("cannot place \"{}\"", fmt::join(app.remaining(), " "));
}

/// Sorts what was given into a command line.
CommandLine command_of(const CLI::App& app, const Values& values, Invocation call) {
  call.sets = values.lists.at("set");
  if (const auto over = values.lists.find("over"); over != values.lists.end()) {
    call.over = over->second;
  }
  CommandLine line;
  for (const auto& [name, value] : values.texts) {
    if (app.count("--" + name) == 0) continue;
    if (name == "json") {
      line.json = value;
    } else if (name == "speed") {
      line.speed = value;
      call.sets.push_back("operation.speed=" + value);
    } else {
      call.given[name] = value;
    }
  }
  for (const auto& [name, is_given] : values.flags) {
    if (is_given && name != "quiet") call.given[name] = "";
  }
  line.is_quiet = values.flags.at("quiet");
  call.shows_progress = !line.is_quiet;
  line.call = std::move(call);
  return line;
}

}  // namespace

std::variant<CommandLine, int> read_command_line(const Verb& verb,
                                                 const std::vector<std::string>& words,
                                                 const StoredModel& stored) {
  CLI::App app;
  Invocation call;
  call.verb = verb.name;
  call.line = words;
  call.model_text = stored.text;
  call.sets_before = stored.sets;
  Values values;
  declare(verb, app, call, values);
  try {
    std::vector<std::string> arguments(words.rbegin(), words.rend() - 2);
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return exit_status::done;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "whirl {}: {}\n(whirl {} --help shows its options)\n", verb.name,
               misplaced(app, words, error), verb.name);
    return exit_status::wrong_input;
  }
  if (call.file.empty()) {
    fmt::print(stderr, "whirl {}: the name of the file is empty\n", verb.name);
    return exit_status::wrong_input;
  }
  return command_of(app, values, call);
}

}  // namespace whirl::inline cli
