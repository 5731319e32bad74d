#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "libio/model/model_schema.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view schema_usage =
    "Usage: whirl schema [--out FILE.json [--force]] [--quiet]\n\nWrites a JSON Schema of model "
    "files. An "
    "editor that knows TOML completes and checks\nkeys with it; in a model's first line: "
    "#:schema ./FILE.json\n";

struct SchemaOptions {
  std::string out;  ///< empty: standard output
  bool is_forced = false;
};

/// What words ask for, in any order; nothing where they mean nothing.
std::optional<SchemaOptions> options_in(const std::vector<std::string>& words) {
  constexpr std::string_view out = "--out";
  SchemaOptions asked;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == out && i + 1 < words.size()) {
      asked.out = words[++i];
    } else if (word.starts_with(out) && word.substr(out.size(), 1) == "=") {
      asked.out = word.substr(out.size() + 1);
    } else if (word == "--force") {
      asked.is_forced = true;
    } else if (word != "--quiet") {  // it says nothing anyway
      return std::nullopt;
    }
  }
  return asked;
}

/// The schema of model files, to a file or to standard output.
int run_schema(const std::vector<std::string>& words, const Ranks*) {
  const auto asked = options_in(words);
  if (!asked) {
    say(stderr, schema_usage);
    return exit_status::wrong_input;
  }
  const std::string text = model_schema().json();
  if (asked->out.empty()) {
    say(stdout, text);
    return after_printing(exit_status::done);
  }
  try {
    replace_file(asked->out, text, asked->is_forced ? Replaces::anything : Replaces::own_pictures);
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
      .options_in_words = {{"out", "FILE.json", "where it goes; left out: standard output"},
                           {"force", "", "replace a file that whirl did not write, too"}},
  };
}

}  // namespace whirl::inline cli
