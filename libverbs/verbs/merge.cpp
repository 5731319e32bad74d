#include <fmt/format.h>

#include <filesystem>

#include "libio/results/call.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/study_part.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/command.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view merge_usage =
    "Usage: whirl merge RESULT.h5 [PART.h5 ...]\n\nJoins the files of the parts of a study "
    "(--part I/N of map, basins, sweep --fresh)\nin one, as if it had been computed at once. What "
    "it has already stays; of parts\nthat are missing it says which. Without parts it takes up the "
    "rows that a stopped\nrun has left beside it.\n";

/// Joins parts of a study in one file.
int run_merge(const std::vector<std::string>& words, const Ranks*) {
  if (words.empty()) {
    say(stdout, merge_usage);
    return exit_status::wrong_input;
  }
  const std::string& whole = words[0];
  std::vector<fs::path> files(words.begin() + 1, words.end());
  const bool is_begun = origin_of(whole) == Origin::result;
  if (is_begun) files.emplace_back(whole);
  try {
    if (files.empty()) throw FileError(fmt::format("{}: there is no such result", whole));
    const ResultReader first(files.front());
    const Call call = without_part(read_call(first));
    const Verb* const verb = verb_named(call.verb);
    if (!verb || !option_named(*verb, "part")) {
      throw FileError(fmt::format("{} is no study that has parts", files.front().string()));
    }
    std::vector<std::string> line = words_again("whirl", call);
    line.push_back("--out=" + whole);
    const StoredModel stored{.text = stored_model(first),
                             .sets = call.sets,
                             .joins = {{words.begin() + 1, words.end()}}};
    const int status = run_command(*verb, line, stored);
    if (status != exit_status::stopped) return status;
    for (const std::string& part : missing_parts({words.begin() + 1, words.end()})) {
      say(stderr, fmt::format("whirl: missing: {}\n", part));
    }
    return exit_status::failed;
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
  };
}

}  // namespace whirl::inline cli
