#include <fmt/format.h>

#include <cstdio>

#include "libio/model/model_schema.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/words.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view schema_usage =
    "Usage: whirl schema [--out FILE.json [--force]] [--quiet]\n\nWrites a JSON Schema of model "
    "files. An "
    "editor that knows TOML completes and checks\nkeys with it; in a model's first line: "
    "#:schema ./FILE.json\n";

struct SchemaOptions {
  Option<std::string> out =
      output_option("out", "FILE.json", "where it goes; left out: standard output", ".json .txt");
  Flag force{"force", "replace a file that whirl did not write, too"};
  Flag quiet = quiet_flag();
  auto fields() { return std::tie(out, force, quiet); }
};

/// The schema of model files, to a file or to standard output.
int run_schema(const std::vector<std::string>& words, const Ranks*) {
  const auto sorted = sorted_words(words, specs_of<SchemaOptions>());
  const auto* read = std::get_if<SortedWords>(&sorted);
  if (!read || !read->alone.empty()) {
    say(stderr, schema_usage);
    return exit_status::wrong_input;
  }
  const auto asked = read_options<SchemaOptions>(read->given);
  const std::string text = model_schema().json();
  if (!asked.out) {
    say(stdout, text);
    return exit_status::done;
  }
  try {
    const std::string problem = ending_problem(*asked.out, asked.out.endings);
    if (!problem.empty()) throw FileError(fmt::format("--out {}: {}", *asked.out, problem));
    replace_file(*asked.out, text, asked.force ? Replaces::anything : Replaces::own_pictures);
  } catch (const FileError& error) {
    return refused(error);
  }
  return exit_status::done;
}

}  // namespace

Verb schema_verb() {
  return {
      .name = "schema",
      .group = "Shells and editors",
      .summary = "a JSON Schema of model files, for editors",
      .takes = "",
      .example = "whirl schema --out whirl.schema.json",
      .run_words = run_schema,
      .usage = schema_usage,
      .options_in_words = specs_of<SchemaOptions>(),
  };
}

}  // namespace whirl::inline cli
