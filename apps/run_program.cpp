#include "apps/run_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "libbase/structs/travel.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/command.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/field_words.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/command/version.hpp"

namespace whirl::inline cli {

namespace {

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
  return text +
         "\nCommon options: --set PATH=VALUE, --speed S, --out FILE.h5, --json FILE, --threads N, "
         "--units LIST, --force, --quiet\n"
         "More: whirl VERB --help, docs/command-line.md, docs/model-file.md\n";
}

/// A verb that does not exist, with where the field's word leads, or with the nearest one.
int unknown_verb(const std::string& word) {
  std::string plain = word;
  for (char& c : plain) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (const std::string_view place = place_of(plain); !place.empty()) {
    say(stderr, fmt::format("whirl: there is no verb \"{}\"; it is {}\n", word, place));
    return exit_status::wrong_input;
  }
  std::vector<std::string> known;
  for (const Verb& verb : verbs()) known.emplace_back(verb.name);
  for (const char* option : {"--help", "--version"}) known.emplace_back(option);
  const auto near = nearest(word, known);
  say(stderr, fmt::format("whirl: there is no {} \"{}\"; {}\n",
                          word.starts_with('-') ? "option" : "verb", word,
                          near ? fmt::format("did you mean \"{}\"?", *near)
                               : fmt::format("known are {}", fmt::join(known, ", "))));
  return exit_status::wrong_input;
}

/// Runs the verb that is the second word.
int run_verb(const std::vector<std::string>& words, const Ranks* ranks) {
  const Verb* const verb = verb_named(words[1]);
  if (!verb) return unknown_verb(words[1]);
  if (!verb->run_words) return run_command(*verb, words, {}, ranks);
  const auto asks_for_help = [](const std::string& w) { return w == "--help" || w == "-h"; };
  if (std::any_of(words.begin() + 2, words.end(), asks_for_help)) {
    say(stdout, verb->usage);
    return exit_status::done;
  }
  return verb->run_words({words.begin() + 2, words.end()}, ranks);
}

/// Runs what the first word asks for.
int run_words(const std::vector<std::string>& words, const Ranks* ranks) {
  const std::string word = words.size() > 1 ? words[1] : "--help";
  if (word == "--help" || word == "-h" || (word == "help" && words.size() == 2)) {
    say(stdout, overview());
    return exit_status::done;
  }
  if (word == "--version") {
    say(stdout, fmt::format("whirl {}\n", version));
    return exit_status::done;
  }
  try {
    return run_verb(word == "help" ? std::vector{words[0], words[2], std::string("--help")} : words,
                    ranks);
  } catch (const std::exception& error) {
    say(stderr, fmt::format("whirl: {}\n", error.what()));  // which may be full too
    return exit_status::failed;
  }
}

}  // namespace

int run_program(const std::vector<std::string>& words, const Ranks* ranks) {
  return after_printing(run_words(words, ranks));
}

void serve_program(const Ranks& ranks) {
  try {
    std::vector<std::string> words;
    unpack(ranks.share({}), words);
    serve_command(*verb_named(words[1]), words, ranks);
    while (true) ranks.share({});  // it shared no work, or failed as the leader does, too
  } catch (const WorkIsDone&) {
  }
}

}  // namespace whirl::inline cli
