// The list of verbs is in order, and the documents say the same.

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace verbs_test {

/// Cells of the table rows in a part of a document.
std::vector<std::vector<std::string>> rows_of(const std::string& part) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(part);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    std::istringstream rest(line.substr(1));
    for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

/// The part of a document below a heading, up to the next heading of that rank.
std::string below(const std::string& document, const std::string& heading) {
  const auto from = document.find("\n" + heading + "\n");
  EXPECT_NE(from, std::string::npos) << heading;
  const std::string rank = "\n" + heading.substr(0, heading.find(' ') + 1);
  return document.substr(from + 1, document.find(rank, from + 1) - from - 1);
}

/// Texts of a cell that stand as code.
std::vector<std::string> code_in(const std::string& cell) {
  static const std::regex code("`([^`]+)`");
  std::vector<std::string> found;
  for (std::sregex_iterator i(cell.begin(), cell.end(), code), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

/// "--modes N" as help and documents write an option.
std::string written(const OptionSpec& option) {
  return "--" + std::string(option.name) +
         (option.is_flag() ? "" : " " + std::string(option.value));
}

std::string manual() {
  return content(WHIRL_SOURCE_DIR "/docs/command-line.md");
}

TEST(Verbs, AreWhole) {
  std::set<std::string_view> names, groups;
  std::string_view group;
  for (const Verb& verb : verbs()) {
    SCOPED_TRACE(verb.name);
    EXPECT_TRUE(names.insert(verb.name).second);
    EXPECT_EQ(verb_named(verb.name), &verb);
    if (!verb.alias.empty()) {
      EXPECT_TRUE(names.insert(verb.alias).second);
      EXPECT_EQ(verb_named(verb.alias), &verb);
      EXPECT_NE(manual().find(fmt::format("`{}`, which is `{}`", verb.alias, verb.name)),
                std::string::npos);
    }
    // a group that comes again would have two headings in the help
    EXPECT_TRUE(verb.group == group || groups.insert(verb.group).second) << verb.group;
    group = verb.group;
    EXPECT_FALSE(verb.summary.empty());
    EXPECT_TRUE(has(std::string(verb.example), "whirl " + std::string(verb.name)));
    EXPECT_NE(verb.run.with == nullptr, verb.run_words == nullptr);
    EXPECT_EQ(verb.run_words != nullptr, !verb.usage.empty());
    std::set<std::string_view> options;
    for (const OptionSpec& option : options_of(verb)) {
      EXPECT_TRUE(options.insert(option.name).second) << option.name;
      EXPECT_FALSE(option.help.empty()) << option.name;
    }
  }
  EXPECT_EQ(verb_named("dance"), nullptr);
}

// Only a default that is used is printed in parentheses behind the help of an option.
TEST(Verbs, StateADefaultInOnePlace) {
  int defaults = 0;
  for (const Verb& verb : verbs()) {
    for (const OptionSpec& option : options_of(verb)) {
      SCOPED_TRACE(std::string(verb.name) + " --" + std::string(option.name));
      static const std::regex number_in_parentheses(R"(\((\d|the default)[^()]*\))");
      const std::string help(option.help);
      EXPECT_FALSE(std::regex_search(help, number_in_parentheses)) << help;
      EXPECT_EQ(help_of(option).ends_with(")") && help != "result file (HDF5)",
                !option.otherwise.empty())
          << help;
      if (option.otherwise.empty()) continue;
      ++defaults;
      EXPECT_FALSE(option.is_flag());
      EXPECT_EQ(help_of(option), help + " (" + std::string(option.otherwise) + ")");
    }
  }
  EXPECT_GT(defaults, 40);
}

using VerbsOfTheProgram = Program;

// CLI11 prints what the list says, wrapped to its columns.
TEST_F(VerbsOfTheProgram, HelpPrintsEveryOptionWithItsDefault) {
  const auto in_one_line = [](const std::string& text) {
    return std::regex_replace(text, std::regex("[ \n]+"), " ");
  };
  for (const Verb& verb : verbs()) {
    if (!verb.run.with) continue;
    SCOPED_TRACE(verb.name);
    const std::string help = in_one_line(whirl({std::string(verb.name), "--help"}).out);
    for (const OptionSpec& option : options_of(verb)) {
      const std::string line = written(option) + " " + help_of(option);
      EXPECT_TRUE(has(help, in_one_line(line))) << line;
    }
  }
}

// Placeholders of values that may be any text stand for names, files and places; all others are read
// before the work, and a wrong one is told with its option.
TEST_F(VerbsOfTheProgram, RefuseValuesThatMeanNothingByTheNamesOfTheirOptions) {
  static const std::regex any_text("FILE.*|OTHER.h5|NAME.*|PATH.*|VALUE.*");
  write("rub.toml", rubbing);
  ASSERT_EQ(whirl({"simulate", "rub.toml", "--discard", "0", "--revolutions", "2", "--out",
                   "run.h5", "--quiet"})
                .status,
            0);
  int refused = 0;
  for (const Verb& verb : verbs()) {
    if (!verb.run.with || verb.name == "import") continue;  // its file is none of ours
    const std::string file = verb.takes == "MODEL" ? "rub.toml" : "run.h5";
    for (const OptionSpec& option : own_options(verb)) {
      if (option.is_flag() || std::regex_match(std::string(option.value), any_text)) continue;
      const std::string dashed = "--" + std::string(option.name);
      const Outcome outcome = whirl({std::string(verb.name), file, dashed, "?"});
      EXPECT_EQ(outcome.status, 2) << verb.name << " " << dashed;
      EXPECT_TRUE(outcome.err.starts_with(dashed + " ?: ")) << verb.name << ": " << outcome.err;
      ++refused;
    }
  }
  EXPECT_GT(refused, 70);
}

TEST(Manual, ListsTheVerbsInTheirOrder) {
  std::vector<std::string> listed, known;
  for (const auto& cells : rows_of(below(manual(), "## Verbs"))) {
    for (const std::string& name : code_in(cells.at(0))) listed.push_back(name);
  }
  for (const Verb& verb : verbs()) known.emplace_back(verb.name);
  EXPECT_EQ(listed, known);
}

TEST(Manual, ListsTheOptionsOfAllVerbs) {
  std::set<std::string> listed, known{"--help"};
  for (const auto& cells : rows_of(below(manual(), "## Options of all verbs"))) {
    for (const std::string& option : code_in(cells.at(0))) listed.insert(option);
  }
  for (const OptionSpec& option : options_of({.name = "any", .group = "", .summary = ""})) {
    known.insert(written(option));
  }
  EXPECT_EQ(listed, known);
}

// Names, placeholders and defaults of the options of each verb; the prose is free.
TEST(Manual, ListsTheOptionsOfEveryVerb) {
  std::map<std::pair<std::string, std::string>, std::string> meanings;  // of verb and option
  const std::string part = below(manual(), "## Options of single verbs");
  for (const auto& cells : rows_of(part.substr(0, part.find("\n### ")))) {
    if (cells.size() < 3) continue;
    for (const std::string& verb : code_in(cells[1])) {
      for (const std::string& option : code_in(cells[0])) {
        meanings[{verb, option}] = std::regex_replace(cells[2], std::regex("`"), "");
      }
    }
  }
  for (const Verb& verb : verbs()) {
    for (const OptionSpec& option : own_options(verb)) {
      SCOPED_TRACE(std::string(verb.name) + " " + written(option));
      const auto row = meanings.find({std::string(verb.name), written(option)});
      if (row == meanings.end()) {
        ADD_FAILURE() << "is not in docs/command-line.md";
        continue;
      }
      const std::string meaning = row->second, value(option.otherwise);
      meanings.erase(row);
      if (value.empty()) continue;
      EXPECT_TRUE(has(meaning, "(" + value + ")") || has(meaning, "(" + value + ";"))
          << "default " << value << ": " << meaning;
    }
  }
  for (const auto& [of, meaning] : meanings) {
    ADD_FAILURE() << of.first << " has no " << of.second << ", as docs/command-line.md says";
  }
}

TEST(Readme, NamesEveryVerb) {
  std::set<std::string> listed, known;
  for (const auto& cells : rows_of(content(WHIRL_SOURCE_DIR "/README.md"))) {
    const std::vector<std::string> names = code_in(cells.at(0));
    if (names.empty() || !names[0].starts_with("whirl ")) continue;
    listed.insert(names[0].substr(6));
    listed.insert(names.begin() + 1, names.end());
  }
  for (const Verb& verb : verbs()) known.emplace(verb.name);
  EXPECT_EQ(listed, known);
}

}  // namespace verbs_test
}  // namespace whirl::test
