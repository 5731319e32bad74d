#include <fmt/format.h>

#include <cstdio>

#include "libio/model/model_schema.hpp"
#include "libio/results/replace_file.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view schema_usage =
    "Usage: whirl schema [--out FILE.json [--force]]\n\nWrites a JSON Schema of model files. An "
    "editor that knows TOML completes and checks\nkeys with it; in a model's first line: "
    "#:schema ./FILE.json\n";

/// The schema of model files, to a file or to standard output.
int run_schema(const std::vector<std::string>& words, const Ranks*) {
  const bool is_forced = words.size() == 3 && words[2] == "--force";
  const bool has_file = (words.size() == 2 || is_forced) && words[0] == "--out";
  if (!words.empty() && !has_file) {
    fmt::print(stderr, "{}", schema_usage);
    return exit_status::wrong_input;
  }
  const std::string text = model_schema().json();
  if (!has_file) {
    std::fputs(text.c_str(), stdout);
    return after_printing(exit_status::done);
  }
  try {
    replace_file(words[1], text, is_forced ? Replaces::anything : Replaces::own_pictures);
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
