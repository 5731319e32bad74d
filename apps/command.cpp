#include "apps/command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "apps/status.hpp"
#include "libio/results/own_file.hpp"
#include "libio/text/bare_speed.hpp"
#include "libio/text/terminal.hpp"
#include "libio/texts/problems_text.hpp"

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
    std::fputs(text.c_str(), stdout);
  } else {
    replace_file(to, text, replaces);
  }
}

/// The speeds of a call that have no unit: of --speed, --set and --over of operation.speed, --at along
/// it, --speeds.
std::vector<BareSpeed> bare_speeds(const CommandLine& line) {
  const Invocation& call = line.call;
  const std::string assigned = "operation.speed=";
  std::vector<BareSpeed> found;
  const auto look_at = [&](const std::string& option, const std::string& value) {
    if (const auto bare = bare_speed(option, value)) found.push_back(*bare);
  };
  if (line.speed) look_at("--speed", *line.speed);
  const std::size_t own = call.sets.size() - (line.speed ? 1 : 0);  // --speed is the last of them
  for (std::size_t i = 0; i < own; ++i) {
    if (!call.sets[i].starts_with(assigned)) continue;
    look_at("--set " + assigned, call.sets[i].substr(assigned.size()));
  }
  if (call.has("speeds")) look_at("--speeds", call.text("speeds"));
  for (const std::string& over : call.over) {
    if (!over.starts_with(assigned)) continue;
    const std::string values = over.substr(assigned.size());
    look_at("--over " + assigned, values);
    // a bare value beside a range with a unit has the range's
    const bool is_along = call.over.size() == 1 && call.has("at");
    if (is_along && is_bare(values)) look_at("--at", call.text("at"));
  }
  return found;
}

/// Problems of a value of --speed are told under that name.
ModelError under_its_option(const ModelError& error, const std::optional<std::string>& speed) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    if (!speed || problem.where.file != "--set operation.speed=" + *speed) continue;
    problem.where.file = "--speed " + *speed;
    problem.key.clear();
  }
  return ModelError(std::move(problems));
}

/// What a verb found goes to the terminal, to standard error and to --json; the status.
int print(Report report, const CommandLine& line, const std::vector<BareSpeed>& bare) {
  if (line.json != "-" && !line.is_quiet) {
    for (const BareSpeed& s : bare) fmt::print("{}\n", s.reading());
    fmt::print("{}{}", bare.empty() ? "" : "\n",
               folded(report.text + notes_text(report.notes), terminal_columns()));
  }
  if (report.failure) {
    fmt::print(stderr, "{}: failed: {}\n", line.call.file, report.failure.text());
  }
  for (const BareSpeed& s : bare) report.notes.push_back(s.warning());
  if (!line.json.empty()) write_json(report, line.json, line.call.picture_replaces());
  return after_printing(report.status);
}

int execute(const Verb& verb, const CommandLine& line) {
  const Invocation& call = line.call;
  if (call.has("threads")) call.integer("threads");  // verbs that use none refuse a wrong one too
  call.require_free_places(line.json);
  const std::vector<BareSpeed> bare = bare_speeds(line);
  if (!line.is_quiet) {
    for (const BareSpeed& s : bare) fmt::print(stderr, "whirl: warning: {}\n", s.warning());
  }
  return print(verb.run(call), line, bare);
}

}  // namespace

int run_command(const Verb& verb, const std::vector<std::string>& words,
                const StoredModel& stored) {
  const auto read = read_command_line(verb, words, stored);
  if (const int* status = std::get_if<int>(&read)) return *status;
  const CommandLine& line = std::get<CommandLine>(read);
  const std::string& file = line.call.file;
  try {
    return execute(verb, line);
  } catch (const ModelError& error) {
    fmt::print(stderr, "{}",
               problems_text(under_its_option(error, line.speed), {file, line.call.model_text}));
    return exit_status::wrong_input;
  } catch (const TakenPlace& error) {
    return refused(error);
  } catch (const FileError& error) {
    return refused(error);
  } catch (const NumericalError& error) {
    fmt::print(stderr, "{}: {}\n", file, error.what());
    return exit_status::failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}: not enough memory for this\n", file);
    return exit_status::failed;
  }
}

}  // namespace whirl::inline cli
