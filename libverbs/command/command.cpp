#include "libverbs/command/command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <stdexcept>

#include "libbase/structs/travel.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/own_file.hpp"
#include "libio/text/bare_speed.hpp"
#include "libio/text/files_in_use.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/terminal.hpp"
#include "libio/texts/problems_text.hpp"
#include "libverbs/command/exit_status.hpp"

namespace whirl::inline cli {

namespace {

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
    say(stdout, text);
  } else {
    begin_last_output(to);
    replace_file(to, text, replaces);
  }
}

/// Where the speeds of a call are given.
SpeedOptions speed_options(const CommandLine& line) {
  const Invocation& call = line.call;
  SpeedOptions given{.speed = line.speed.value_or(""),
                     .sets = call.sets,
                     .speeds = call.text("speeds"),
                     .over = call.values("over"),
                     .at = call.text("at")};
  for (const char* name : {"minimum-speed", "maximum-speed", "trip-speed"}) {
    given.others.emplace_back(std::string("--") + name, call.text(name));
  }
  if (line.speed) given.sets.pop_back();  // --speed is the last of them
  return given;
}

/// A problem of an option that a library names is told of what was given, where the verb has it;
/// problems of values of --speed and --over are told under these names.
ModelError under_its_option(const ModelError& error, const CommandLine& line) {
  if (const auto* wrong = dynamic_cast<const OptionError*>(&error);
      wrong && option_named(*verb_named(line.call.verb), wrong->option())) {
    return wrong_option(wrong->option(), line.call.text(wrong->option()),
                        wrong->problems().front().message);
  }
  const ModelError told = under_over(error, line.call.values("over"), line.call.sets);
  if (!line.speed) return told;
  return renamed(told, "--set operation.speed=" + *line.speed, "--speed " + *line.speed);
}

/// What a verb found goes to the terminal, to standard error and to --json; the status.
int print(Report report, const Invocation& call, const std::vector<BareSpeed>& bare) {
  const std::string json = call.output.json.value_or("");
  if (json != "-" && !call.output.quiet) {
    for (const BareSpeed& s : bare) say(stdout, fmt::format("{}\n", s.reading()));
    say(stdout, fmt::format("{}{}", bare.empty() ? "" : "\n",
                            folded(report.text + notes_text(report.notes), terminal_columns())));
  }
  if (report.failure) {
    say(stderr, fmt::format("{}: failed: {}\n", call.file, report.failure.text()));
  }
  for (const BareSpeed& s : bare) report.notes.push_back(s.warning());
  if (!json.empty()) write_json(report, json, call.picture_replaces());
  return report.status;
}

/// Checks the --isa of a command that ranks run again: they have agreed on one before it was read.
/// @throws ModelError  if theirs rounds otherwise
void require_agreed(const std::string& asked) {
  if (asked.empty() || rounds_alike(asked, instruction_set())) return;
  throw ModelError({"--isa " + asked}, "",
                   fmt::format("the processes have agreed on {}, which rounds otherwise; say it to "
                               "whirl-mpi rerun, too",
                               instruction_set()));
}

int short_of_memory(const std::string& file) {
  say(stderr, fmt::format("{}: not enough memory for this\n", file));
  return exit_status::failed;
}

int execute(const Verb& verb, CommandLine& line) {
  Invocation& call = line.call;
  call.prepare();
  if (call.ranks && !call.model_text.empty()) require_agreed(call.text("isa"));
  const std::vector<BareSpeed> bare = bare_speeds(speed_options(line));
  if (!call.output.quiet) {
    for (const BareSpeed& s : bare) say(stderr, fmt::format("whirl: warning: {}\n", s.warning()));
  }
  return print(verb.run.with(call), call, bare);
}

}  // namespace

int run_command(const Verb& verb, const std::vector<std::string>& words, const StoredModel& stored,
                const Ranks* ranks) {
  const FilesInUse files;
  auto read = read_command_line(verb, words, stored);
  if (const int* status = std::get_if<int>(&read)) return *status;
  CommandLine& line = std::get<CommandLine>(read);
  const std::string& file = line.call.file;
  if (ranks && shares_work(verb, line.call.given)) {
    ranks->share([&] { return packed(words); });
    line.call.ranks = ranks;
  }
  try {
    return execute(verb, line);
  } catch (const ModelError& error) {
    say(stderr, problems_text(under_its_option(error, line), {file, line.call.model_text}));
    return exit_status::wrong_input;
  } catch (const FileError& error) {
    return refused(error);
  } catch (const NumericalError& error) {
    say(stderr, fmt::format("{}: {}\n", file, error.what()));
    return exit_status::failed;
  } catch (const std::bad_alloc&) {
    return short_of_memory(file);
  } catch (const std::length_error&) {  // more than any container can have
    return short_of_memory(file);
  }
}

void serve_command(const Verb& verb, const std::vector<std::string>& words, const Ranks& ranks) {
  auto read = read_command_line(verb, words, {});
  CommandLine* const line = std::get_if<CommandLine>(&read);
  if (!line) return;
  Invocation& call = line->call;
  call.ranks = &ranks;
  call.sets.clear();                                   // the leader's model has them in it
  for (const OptionSpec& option : options_of(verb)) {  // the leader writes
    if (option.writes()) call.given.erase(std::string(option.name));
  }
  for (const char* leaders : {"force", "restart"}) call.given.erase(leaders);
  call.given["quiet"] = {""};
  call.output = read_options<OutputOptions>(call.given);
  try {
    verb.run.with(call);
  } catch (const LostRank&) {
    throw;
  } catch (const std::exception&) {
    ranks.send({0, LetterKind::error, packed_error(std::current_exception())});
  }
}

}  // namespace whirl::inline cli
