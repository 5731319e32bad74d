// No function is long, and no class is wide: one of more than 80 lines, or of more than 25 members,
// has a second idea in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace functions_test {

namespace fs = std::filesystem;

/// Calls f with every source of the product, and its path.
void for_each_source(const std::function<void(const fs::path&, std::istream&)>& f) {
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libdata", "libio",
                             "libverbs", "apps", "python"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(WHIRL_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
      std::ifstream file(entry.path());
      f(entry.path(), file);
    }
  }
}

struct Function {
  std::string head;
  int lines;  // from its head, without the line of a template, to its closing brace
};

/// Functions of a source as clang-format sets it, and blocks within them: what begins with a line,
/// ends with a brace below its first column and has parentheses before its opening brace.
std::vector<Function> functions_in(std::istream& source) {
  static const std::regex no_function(R"(^\s*(namespace|class|struct|union|enum)\b)");
  struct Start {
    std::string head;
    int number;
    bool is_open;  // the head goes on
  };
  std::map<std::size_t, Start> starts;  // by column; of all that is not closed yet
  std::vector<Function> found;
  int number = 0;
  for (std::string line; std::getline(source, line);) {
    ++number;
    const std::size_t column = line.find_first_not_of(' ');
    if (column == std::string::npos || line[column] == '#') continue;
    line.erase(std::min(line.find("//", column), line.size()));
    line.erase(line.find_last_not_of(' ') + 1);
    if (line.empty()) continue;
    starts.erase(starts.upper_bound(column), starts.end());
    const auto start = starts.find(column);
    if (line[column] == '}' && start != starts.end()) {
      const std::string& head = start->second.head;
      const bool is_function = head.ends_with(" {") && !head.ends_with("= {") &&
                               head.find('(') != std::string::npos &&
                               !std::regex_search(head, no_function);
      if (is_function) found.push_back({head, number - start->second.number + 1});
    }
    if (line[column] != '}') starts[column] = {"", number, true};
    for (auto& [at, s] : starts) {
      if (!s.is_open) continue;
      s.head += line;
      s.is_open = line.back() != '{' && line.back() != ';';
    }
  }
  return found;
}

TEST(Functions, AreCountedAndNothingElse) {
  const std::string lines(79, '\n');
  const auto longest = [](const std::string& text) {
    std::istringstream source(text);
    int most = 0;
    for (const Function& f : functions_in(source)) most = std::max(most, f.lines);
    return most;
  };
  EXPECT_EQ(longest("void f() {  // g" + lines + "}\n"), 80);
  EXPECT_EQ(longest("A::A(int a,\n     int b)\n    : a_(a) {" + lines + "}\n"), 82);
  EXPECT_EQ(longest("struct A {\n  int f() const {" + lines + "  }\n};\n"), 80);
  EXPECT_EQ(longest("template <class P>\nvoid f(\n    int a) {\n  if (a) {\n    g();\n  }" + lines +
                    "}  // f\n"),
            84);
  EXPECT_EQ(longest("void f() {\n  g();\n}\nnamespace a {\nenum B {" + lines + "};\n}\n"), 3);
  EXPECT_EQ(longest("struct A {\n  int b = f(1);" + lines + "};\n"), 0);
  EXPECT_EQ(longest("const int a[] = {\n" + lines + "};\n"), 0);
  EXPECT_EQ(longest("const std::function<int(int)> a{\n" + lines + "};\n"), 0);
}

TEST(Architecture, NoFunctionIsTooLong) {
  constexpr int most = 80;
  std::size_t count = 0;
  for_each_source([&](const fs::path& path, std::istream& file) {
    for (const Function& f : functions_in(file)) {
      ++count;
      EXPECT_LE(f.lines, most) << path << ": " << f.head;
    }
  });
  EXPECT_GT(count, 5000u);  // the scan found them
}

/// Members of the classes of a source as clang-format sets it: what begins in the third column
/// between the head of a class, which begins a line, and its closing brace; functions and data
/// alike, without those that only say something to the compiler.
std::map<std::string, int> members_in(std::istream& source) {
  static const std::regex head(
      R"(^(?:class|struct) (?:\w+ )*?(\w+)(?:<.*>)?(?: final)?(?: :.*)? \{$)"),
      member(R"(^  [^ /}#:])"),
      no_member(R"(^  (?:template|requires|using|friend|static_assert|HWY_ATTR$|__attribute__\S*$))"
                R"(|^  .* = delete;$)");
  std::map<std::string, int> found;
  std::string name;
  for (std::string line; std::getline(source, line);) {
    std::smatch match;
    if (std::regex_match(line, match, head)) {
      name = match[1];
      found[name] = 0;
    } else if (line.starts_with("};")) {
      name.clear();
    } else if (!name.empty() && std::regex_search(line, member) &&
               !std::regex_search(line, no_member)) {
      ++found[name];
    }
  }
  return found;
}

TEST(Classes, AreCounted) {
  std::istringstream source(
      "class A : public B {\n public:\n  /// Says.\n  A();\n  template <class T>\n  void f(int a,\n"
      "         int b) {\n    g();\n  }\n\n private:\n  using T = int;\n  int a_ = 0;  ///< "
      "x\n};\n");
  EXPECT_EQ(members_in(source), (std::map<std::string, int>{{"A", 3}}));
}

// Wider ones are named here with why, and do not grow.
TEST(Architecture, NoClassIsTooWide) {
  constexpr int most = 25;
  struct Wide {
    int members;
    const char* why;
  };
  const std::map<std::string, Wide> known = {
      {"ContactLanes", {66, "the coefficients of one contact, which its loop holds together"}},
      {"ContactSystem", {46, "the equations of motion, asked for in the words of every method"}},
      {"TableReader", {38, "a function for every kind of value that a table may hold"}},
      {"ResultWriter", {28, "a function for every kind of value that a file may hold"}},
      {"ResultReader", {27, "a function for every kind of value that a file may hold"}},
      {"Writer", {27, "a function for every table of a file"}},
      {"Builder", {27, "the calls that a parser of JSON makes"}},
      {"LinearFlow", {26, "tables and what is done with them"}},
      {"Structure", {31, "a list for every kind of part that a model may have"}},
      {"Assembler", {28, "all that a structure says at a speed: matrices, loads, places, ratios"}},
  };
  std::map<std::string, int> wide;
  for_each_source([&](const fs::path& path, std::istream& file) {
    for (const auto& [name, count] : members_in(file)) {
      if (count <= most) continue;
      wide[name] = count;
      const auto at = known.find(name);
      EXPECT_NE(at, known.end()) << path << ": " << name << " has " << count;
      if (at != known.end()) {
        EXPECT_LE(count, at->second.members) << path << ": " << name << ", " << at->second.why;
      }
    }
  });
  for (const auto& [name, members] : known) {
    EXPECT_EQ(wide[name], members.members) << name << " is narrower now: say so here";
  }
}

}  // namespace functions_test
