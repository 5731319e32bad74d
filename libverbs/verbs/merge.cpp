#include <fmt/format.h>

#include <filesystem>

#include "libio/results/call.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/study_part.hpp"
#include "libio/text/files_in_use.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/command.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/words.hpp"

namespace whirl::inline cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view merge_usage =
    "Usage: whirl merge RESULT.h5 [PART.h5 ...] [--json FILE] [--force] [--quiet]\n\nJoins the "
    "files of the parts of a study "
    "(--part I/N of map, basins, sweep --fresh)\nin one, as if it had been computed at once. What "
    "it has already stays; of parts\nthat are missing it says which. Without parts it takes up the "
    "rows that a stopped\nrun has left beside it.\n";

struct MergeOptions {
  Option<std::string> json = json_option();
  Flag force{"force", "replace files that whirl did not write, too"};
  Flag quiet = quiet_flag();
  auto fields() { return std::tie(json, force, quiet); }
};

/// The call of a file that a study is joined of or in.
/// @param is_whole  the file takes what the others have
Call call_to_join(const ResultReader& file, bool is_whole) {
  const Call call = read_call(file);
  const Verb* const verb = verb_named(call.verb);
  if (!verb || !option_named(*verb, "part")) {
    throw FileError(fmt::format("{} is no study that has parts", file.path().string()));
  }
  if (is_whole && !stripe_of(call).is_all()) {
    throw FileError(
        fmt::format("{} is a part of a study: name the file of the whole before it, "
                    "whirl merge WHOLE.h5 PART.h5 ...",
                    file.path().string()));
  }
  return call;
}

/// Joins parts of a study in one file.
/// @param whole  its name
/// @param given  what the line says else
int join(const std::string& whole, const std::vector<std::string>& parts,
         const GivenValues& given) {
  const FilesInUse in_use;
  std::vector<fs::path> files(parts.begin(), parts.end());
  const bool is_begun = origin_of(whole) == Origin::result;
  if (is_begun) files.emplace_back(whole);
  if (files.empty()) throw FileError(fmt::format("{}: there is no such result", whole));
  std::optional<LooksAtOutput> look(std::in_place);
  if (is_begun) call_to_join(ResultReader(whole), !parts.empty());
  const ResultReader first(files.front());
  look.reset();
  const Call stored_call = call_to_join(first, false);
  const Call call = parts.empty() ? stored_call : without_part(stored_call);
  const Verb& verb = *verb_named(call.verb);
  std::vector<std::string> line = words_again("whirl", call, left_out_again(verb, {}));
  line.push_back("--out=" + whole);
  for (const auto& [name, values] : given) {
    line.push_back("--" + name + (values[0].empty() ? "" : "=" + values[0]));
  }
  const StoredModel study{.text = stored_model(first), .sets = call.sets, .joins = parts};
  const int status = run_command(verb, line, study);
  if (status != exit_status::stopped) return status;
  for (const std::string& part : missing_parts({parts.begin(), parts.end()})) {
    say(stderr, fmt::format("whirl: missing: {}\n", part));
  }
  return exit_status::failed;
}

int run_merge(const std::vector<std::string>& words, const Ranks*) {
  const auto sorted = sorted_words(words, specs_of<MergeOptions>());
  if (const auto* problem = std::get_if<std::string>(&sorted)) {
    say(stderr, fmt::format("whirl merge: {}\n(whirl merge --help shows its options)\n", *problem));
    return exit_status::wrong_input;
  }
  const auto& [files, given] = std::get<SortedWords>(sorted);
  if (files.empty()) {
    say(stdout, merge_usage);
    return exit_status::wrong_input;
  }
  try {
    return join(files[0], {files.begin() + 1, files.end()}, given);
  } catch (const FileError& error) {
    return refused(error);
  }
}

}  // namespace

Verb merge_verb() {
  return {
      .name = "merge",
      .group = "Results",
      .summary = "joins the files of parts of a study",
      .takes = "RESULT.h5",
      .takes_more = "PART.h5",
      .takes_more_help = "files of its parts",
      .example = "whirl merge atlas.h5 atlas.part1of2.h5 atlas.part2of2.h5",
      .run_words = run_merge,
      .usage = merge_usage,
      .options_in_words = specs_of<MergeOptions>(),
  };
}

}  // namespace whirl::inline cli
