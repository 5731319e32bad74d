// The list of verbs is in order, and the documents say the same.

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>

#include "libverbs/command/field_words.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/manual.hpp"

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

std::string trimmed(const std::string& cell) {
  const auto first = cell.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return cell.substr(first, cell.find_last_not_of(' ') + 1 - first);
}

/// "--modes N" as help and documents write an option.
std::string written(const OptionSpec& option) {
  return "--" + std::string(option.name) +
         (option.is_flag() ? "" : " " + std::string(option.value));
}

std::string manual() {
  return command_line_manual();
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
      const std::string range = option.range.empty() ? "" : "; " + option.range;
      EXPECT_EQ(help_of(option), help + range + " (" + std::string(option.otherwise) + ")");
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

// Placeholders of values that may be any text stand for names, files and places; all others are
// read before the work, and a wrong one is told with its option.
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
        ADD_FAILURE() << "is not in docs/options.md";
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
    ADD_FAILURE() << of.first << " has no " << of.second << ", as docs/options.md says";
  }
}

// No number from outside costs in proportion to itself without an end: every whole number has a
// range (a declaration without one does not compile), and the table of limits says it.
TEST(Manual, ListsTheRangeOfEveryWholeNumber) {
  std::map<std::pair<std::string, std::string>, std::string> listed, known;  // of verb and option
  const std::string part = below(manual(), "### Limits");
  for (const auto& cells : rows_of(part.substr(0, part.find("\n| of |")))) {
    if (cells.size() < 3) continue;
    const auto verbs_of =
        trimmed(cells[1]) == "all" ? std::vector<std::string>{"all"} : code_in(cells[1]);
    for (const std::string& verb : verbs_of) {
      for (const std::string& option : code_in(cells[0]))
        listed[{verb, option}] = trimmed(cells[2]);
    }
  }
  const auto add = [&](const std::string& verb, const std::vector<OptionSpec>& options) {
    for (const OptionSpec& option : options) {
      if (!option.range.empty()) known[{verb, written(option)}] = option.range;
    }
  };
  add("all", options_of({.name = "any", .group = "", .summary = ""}));
  for (const Verb& verb : verbs()) add(std::string(verb.name), own_options(verb));
  EXPECT_GT(known.size(), 60u);
  EXPECT_EQ(listed, known);
}

TEST(Manual, ListsTheWordsOfTheField) {
  std::vector<std::pair<std::string, std::string>> listed, known;
  for (const auto& cells : rows_of(below(manual(), "## Words of the field"))) {
    if (cells.size() == 2 && !code_in(cells[0]).empty()) {
      listed.emplace_back(code_in(cells[0]).front(), trimmed(cells[1]));
    }
  }
  for (const FieldWord& field : field_words) known.emplace_back(field.word, field.place);
  EXPECT_EQ(listed, known);
}

// Where a word leads there is a verb, and a kind of figure that the manual knows.
TEST(FieldWords, LeadToVerbsAndFiguresThatThereAre) {
  static const std::regex verb_in(R"(whirl (\w+))"), figure_in(R"(whirl plot \S+ (\w+)`)");
  for (const FieldWord& field : field_words) {
    SCOPED_TRACE(field.word);
    const std::string place(field.place);
    EXPECT_EQ(verb_named(field.word), nullptr);
    int count = 0;
    for (std::sregex_iterator i(place.begin(), place.end(), verb_in), end; i != end; ++i, ++count) {
      EXPECT_NE(verb_named((*i)[1].str()), nullptr) << (*i)[1];
    }
    EXPECT_GT(count, 0);
    std::smatch figure;
    if (!std::regex_search(place, figure, figure_in)) continue;
    const std::regex row("\n\\| [^|]*`" + figure[1].str() + "`[^|]*\\|");
    EXPECT_TRUE(std::regex_search(manual(), row)) << figure[1];
  }
}

TEST_F(VerbsOfTheProgram, TellWhereTheWordsOfTheFieldLead) {
  for (const FieldWord& field : field_words) {
    const Outcome outcome = whirl({std::string(field.word), "rotor.toml"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err,
              fmt::format("whirl: there is no verb \"{}\"; it is {}\n", field.word, field.place));
  }
}

// A key without its tables is answered with its path, in every option that takes one.
TEST_F(VerbsOfTheProgram, TellThePathOfAKeyAlone) {
  write("rub.toml", rubbing);
  const auto problem = [&](const std::vector<std::string>& words) { return whirl(words).err; };
  const std::string speed = problem({"sweep", "rub.toml", "--over", "speed=90:100:1"});
  EXPECT_TRUE(has(speed, "did you mean operation.speed?")) << speed;
  const std::string friction = problem({"simulate", "rub.toml", "--set", "clearance=1mm"});
  EXPECT_TRUE(has(friction, "did you mean contact.")) << friction;
  write("run.csv", "time [s],x [um]\n0,1\n0.001,2\n");
  const std::string free =
      problem({"fit", "rub.toml", "--measured", "run.csv", "--free", "clearance"});
  EXPECT_TRUE(has(free, "did you mean contact.")) << free;
}

// Threads are started one after another as long as the system gives them: a thousand million of
// them took the machine down.
TEST_F(VerbsOfTheProgram, StartNoMoreThreadsThanTheLimit) {
  write("rub.toml", rubbing);
  const Outcome outcome =
      whirl({"sweep", "rub.toml", "--over", "operation.speed=90:100:5", "--threads", "1025"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "--threads 1025: expected a whole number from 1 to 1024\n");
}

}  // namespace verbs_test
}  // namespace whirl::test
