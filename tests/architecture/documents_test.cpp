// Documents lead where they say: files, folders and headings that they name are there. Docstrings
// say of the parameters that there are, in the words that tools/docs knows.

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace documents_test {

namespace fs = std::filesystem;
const fs::path root = WHIRL_SOURCE_DIR;
constexpr const char* libraries[] = {"libbase", "libfe", "libcontact", "libdyn",
                                     "libdata", "libio", "libverbs"};

std::vector<fs::path> documents() {
  std::vector<fs::path> folders{root, root / "docs", root / "python"};
  for (const char* library : libraries) folders.push_back(root / library);
  folders.push_back(root / "libdyn/taylor");
  std::vector<fs::path> all;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".md") all.push_back(entry.path());
    }
  }
  return all;
}

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Lines of a document outside blocks of code.
std::vector<std::string> prose(const fs::path& document) {
  std::vector<std::string> lines;
  std::ifstream file(document);
  bool is_code = false;
  for (std::string line; std::getline(file, line);) {
    const bool is_fence = line.starts_with("```");
    if (!is_code && !is_fence && !line.starts_with("    ")) lines.push_back(line);
    is_code = is_code != is_fence;
  }
  return lines;
}

/// The anchor of a heading, as GitHub and tools/docs make it.
std::string anchor(const std::string& heading) {
  std::string made;
  for (const char c : heading.substr(heading.find(' ') + 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) || c == '_' || c == '-') {
      made += static_cast<char>(std::tolower(byte));
    } else if (c == ' ') {
      made += '-';
    }
  }
  return made;
}

std::multiset<std::string> anchors(const fs::path& document) {
  std::multiset<std::string> all;
  for (const std::string& line : prose(document)) {
    if (line.starts_with("#")) all.insert(anchor(line));
  }
  return all;
}

/// Targets of the links and pictures of a document.
std::vector<std::string> targets(const fs::path& document) {
  static const std::regex link(R"(\[[^\]]*\]\(([^)\s]+)\))");
  std::string text;
  bool is_code = false;  // within backticks
  for (const std::string& line : prose(document)) {
    for (const char c : line) {
      if (c == '`') is_code = !is_code;
      if (!is_code) text += c;
    }
    text += ' ';
  }
  std::vector<std::string> all;
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
    all.push_back((*i)[1].str());
  }
  return all;
}

TEST(Documents, NameFilesThatAreThere) {
  static const std::regex path_of(
      "`((libbase|libfe|libcontact|libdyn|libdata|libio|libverbs|apps|bench|examples|tests|models|"
      "tools|web|docs)/[A-Za-z0-9_./-]+)`");
  int found = 0;
  for (const fs::path& document : documents()) {
    const std::string all = content(document);
    for (std::sregex_iterator i(all.begin(), all.end(), path_of), end; i != end; ++i) {
      ++found;
      EXPECT_TRUE(fs::exists(root / (*i)[1].str())) << document << " names " << (*i)[1];
    }
  }
  EXPECT_GT(found, 50);
}

TEST(Documents, LinkToFilesAndHeadingsThatAreThere) {
  int found = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& target : targets(document)) {
      if (target.starts_with("https://")) continue;
      ++found;
      const std::size_t hash = target.find('#');
      const std::string path = target.substr(0, hash);
      const fs::path to = path.empty() ? document : document.parent_path() / path;
      EXPECT_TRUE(fs::exists(to)) << document << " links to " << target;
      if (hash == std::string::npos || !fs::exists(to)) continue;
      EXPECT_EQ(anchors(to).count(target.substr(hash + 1)), 1u)
          << document << " links to " << target << ": headings of this name";
    }
  }
  EXPECT_GT(found, 100);
}

// Tables of docs/validation.md head what is printed in a source as `printed`, what a program of
// ours finds as `own program`, and what is known as `closed form`: a column headed `paper` held
// numbers of all three.
TEST(Documents, ValidationHeadsItsReferencesByTheirKind) {
  std::string before;
  int tables = 0;
  for (const std::string& line : prose(root / "docs/validation.md")) {
    if (line.starts_with("|---")) {
      ++tables;
      EXPECT_EQ(before.find("paper"), std::string::npos) << before;
      EXPECT_EQ(before.find("independent program"), std::string::npos) << before;
    }
    before = line;
  }
  EXPECT_GT(tables, 30);
}

// docs/cpp.md names an example before each passage of it; examples are programs that the tests run.
TEST(Documents, QuoteExamplesAsTheyAre) {
  static const std::regex example("`(examples/[0-9a-z_]+\\.cpp)`"), indent("\\n +");
  const auto flush = [&](const std::string& code) {
    return std::regex_replace("\n" + code, indent, "\n");
  };
  std::ifstream document(root / "docs/cpp.md");
  std::set<std::string> quoted;
  std::string named, passage;
  bool is_code = false;
  for (std::string line; std::getline(document, line);) {
    std::smatch name;
    if (line == "```cpp") {
      is_code = true;
      passage.clear();
    } else if (is_code && line == "```") {
      is_code = false;
      quoted.insert(named);
      EXPECT_NE(flush(content(root / named)).find(flush(passage)), std::string::npos)
          << named << " has not\n"
          << passage;
    } else if (is_code) {
      passage += line + "\n";
    } else if (std::regex_search(line, name, example)) {
      named = name[1];
    }
  }
  std::set<std::string> all;
  for (const auto& entry : fs::directory_iterator(root / "examples")) {
    if (entry.path().extension() == ".cpp")
      all.insert("examples/" + entry.path().filename().string());
  }
  EXPECT_EQ(quoted, all);
}

TEST(Documents, HaveHeadingsOfDifferentNames) {
  for (const fs::path& document : documents()) {
    if (document.filename() == "CHANGELOG.md") continue;  // the same for every version
    const auto all = anchors(document);
    for (const std::string& name : all) {
      EXPECT_EQ(all.count(name), 1u) << document << " has #" << name;
    }
  }
}

/// A docstring, and the declaration behind it up to its body.
struct Docstring {
  std::string text, declaration;
};

std::vector<Docstring> docstrings(const fs::path& header) {
  std::vector<Docstring> all;
  std::ifstream file(header);
  bool is_open = false;  // in a docstring, or in the declaration behind it
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool is_comment = first != std::string::npos && line.compare(first, 3, "///") == 0;
    if (is_comment) {
      if (!is_open || !all.back().declaration.empty()) all.emplace_back();
      all.back().text += line.substr(first + 3) + "\n";
      is_open = true;
    } else if (is_open) {
      all.back().declaration += line + "\n";
      is_open =
          !line.empty() && std::string_view(";{}").find(line.back()) == std::string_view::npos;
    }
  }
  return all;
}

TEST(Docstrings, SayWhatToolsDocsKnowsOfParametersThatThereAre) {
  static const std::regex command(R"(@(\w+)[ ]*([\w, ]*))");
  const std::set<std::string> known{"param", "return", "throws", "source", "pre"};
  int found = 0;
  for (const char* library : libraries) {
    for (const auto& entry : fs::recursive_directory_iterator(root / library)) {
      if (entry.path().extension() != ".hpp") continue;
      for (const auto& [text, declaration] : docstrings(entry.path())) {
        for (std::sregex_iterator i(text.begin(), text.end(), command), end; i != end; ++i) {
          const std::string word = (*i)[1].str(), rest = (*i)[2].str();
          if (i->position() > 1 && text.substr(i->position() - 2, 2) != "\n ") continue;
          ++found;
          EXPECT_TRUE(known.contains(word)) << entry.path() << ": @" << word;
          if (word != "param") continue;
          const std::string name = rest.substr(0, rest.find_first_of(", "));
          EXPECT_TRUE(std::regex_search(declaration, std::regex("\\b" + name + "\\b")))
              << entry.path() << ": @param " << name << " of\n"
              << declaration;
        }
      }
    }
  }
  EXPECT_GT(found, 300);
}

// Whoever follows one tutorial after another in one folder keeps what each of them made.
TEST(Documents, TutorialsWriteToFilesOfTheirOwn) {
  static const std::regex written(R"((?:--(?:out|measured-out|svg|json)[ =]|```\w+ )([^\s`]+))");
  std::map<std::string, std::set<std::string>> by_file;
  for (const fs::path& document : documents()) {
    const std::string name = document.filename().string(), text = content(document);
    if (!name.starts_with("tutorial")) continue;
    for (std::sregex_iterator i(text.begin(), text.end(), written), end; i != end; ++i) {
      by_file[(*i)[1]].insert(name);
    }
  }
  EXPECT_GT(by_file.size(), 10u);
  for (const auto& [file, names] : by_file) EXPECT_EQ(names.size(), 1u) << file;
}

// What is counted has a place among the benchmarks.
TEST(Documents, NameEveryRowOfInstructions) {
  const std::string benchmarks = content(root / "docs/benchmarks.md");
  std::ifstream table(root / "bench/instructions/table.tsv");
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    const std::string name = line.substr(0, line.find('\t'));
    EXPECT_NE(benchmarks.find('`' + name + '`'), std::string::npos)
        << "docs/benchmarks.md does not name `" << name << "`";
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

}  // namespace documents_test
