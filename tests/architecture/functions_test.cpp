// No function is long: one of more than 80 lines has a second idea in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace functions_test {

namespace fs = std::filesystem;

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
  for (const char* folder : {"libbase", "libfe", "libcontact", "libdyn", "libdata", "libio",
                             "libverbs", "apps", "python"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(WHIRL_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
      std::ifstream file(entry.path());
      for (const Function& f : functions_in(file)) {
        ++count;
        EXPECT_LE(f.lines, most) << entry.path() << ": " << f.head;
      }
    }
  }
  EXPECT_GT(count, 5000u);  // the scan found them
}

}  // namespace functions_test
