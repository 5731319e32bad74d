// The only file that sees CLI11.

#include "libverbs/command/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <span>

#include "libio/text/nearest.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/exit_status.hpp"

namespace whirl::inline cli {

namespace {

std::string dashed(const OptionSpec& option) {
  return "--" + std::string(option.name);
}

std::string help_of_file(std::string_view takes) {
  if (takes == "MODEL") return "model file (TOML)";
  return takes == "RESULT.h5" ? "result file (HDF5)" : "result file (HDF5) or model file (TOML)";
}

/// Tells CLI11 the files and options of a verb.
void declare(const Verb& verb, CLI::App& app, Invocation& call) {
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
    const std::string name = dashed(option), help = help_of(option);
    if (option.is_flag()) {
      app.add_flag(name, help);
      continue;
    }
    app.add_option(name, help)
        ->type_name(std::string(option.value))
        ->allow_extra_args(false)
        ->multi_option_policy(option.is_list ? CLI::MultiOptionPolicy::TakeAll
                                             : CLI::MultiOptionPolicy::TakeLast);
  }
}

/// Words in which every value of a list has its option: one --over may have several values, "--over
/// a=1:2 b=3:4", and files may stand behind them.
std::vector<std::string> with_lists_apart(const Verb& verb, const std::vector<std::string>& words) {
  std::vector<std::string> apart;
  std::string list;  // whose value may follow
  bool is_first = false;
  for (const std::string& word : words) {
    const bool is_value = is_first || (!word.starts_with("--") && word.find('=') != word.npos);
    if (!list.empty() && is_value) {
      apart.push_back(list + "=" + word);
      is_first = false;
      continue;
    }
    const auto option = word.starts_with("--") ? option_named(verb, word.substr(2)) : std::nullopt;
    is_first = option && option->is_list;
    list = is_first ? word : "";
    if (!is_first) apart.push_back(word);
  }
  if (is_first) apart.push_back(list);  // without its value
  return apart;
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
  const std::string problem = fmt::format("cannot place \"{}\"", fmt::join(app.remaining(), " "));
  // "whirl orbit plot MODEL"
  if (words.size() < 3 || words[2] != "plot") return problem;
  const std::string_view motion = words[1] == "orbit" ? "simulate" : std::string_view(words[1]);
  return problem +
         fmt::format("; a picture is `whirl {} MODEL --out r.h5`, then `whirl plot r.h5 {}`",
                     motion, words[1]);
}

/// Sorts what was given into a command line.
CommandLine command_of(const Verb& verb, const CLI::App& app, Invocation call) {
  for (const OptionSpec& option : options_of(verb)) {
    const CLI::Option& read = *app.get_option(dashed(option));
    if (read.count() == 0 || (option.is_flag() && !read.as<bool>())) continue;
    std::vector<std::string>& values = call.given[std::string(option.name)] = read.results();
    if (!option.is_list) values = {option.is_flag() ? "" : values.back()};
  }
  const auto model = read_options<ModelOptions>(call.given);
  call.sets = model.sets.values;
  if (model.speed) call.sets.push_back("operation.speed=" + *model.speed);
  return {std::move(call), model.speed.value};
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
  call.joins = stored.joins;
  declare(verb, app, call);
  try {
    const std::vector<std::string> apart = with_lists_apart(verb, {words.begin() + 2, words.end()});
    std::vector<std::string> arguments(apart.rbegin(), apart.rend());
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    say(stdout, app.help());
    return exit_status::done;
  } catch (const CLI::ParseError& error) {
    say(stderr, fmt::format("whirl {}: {}\n(whirl {} --help shows its options)\n", verb.name,
                            misplaced(app, words, error), verb.name));
    return exit_status::wrong_input;
  }
  if (call.file.empty()) {
    say(stderr, fmt::format("whirl {}: the name of the file is empty\n", verb.name));
    return exit_status::wrong_input;
  }
  return command_of(verb, app, std::move(call));
}

}  // namespace whirl::inline cli
