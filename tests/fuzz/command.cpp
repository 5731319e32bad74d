// Command lines over all verbs: a verb does what it is asked for, or an error says what is wrong.
//
// An input is words, a line each, the first one a verb. They find a model, a probe file, a record
// and a result in the folder where they run, and no other: words with a slash are left out, and so
// are numbers of many digits, which may ask for much work. A study is stopped at once.

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/processes/ranks.hpp"
#include "libio/results/replace_file.hpp"
#include "libverbs/command/command_line.hpp"
#include "libverbs/command/verb.hpp"
#include "tests/fuzz/scratch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace whirl;

/// The folder, with what commands read.
struct Folder : fuzz::Scratch {
  Folder() {
    const fs::path source = WHIRL_SOURCE_DIR;
    fs::copy_file(source / "models/jeffcott.toml", folder / "model.toml");
    fs::copy_file(source / "tests/fuzz/results/sweep.h5", folder / "run.h5");
    std::ofstream(folder / "record.csv") << "time [s],x [um]\n0,1\n0.001,2\n0.002,1\n";
    std::ofstream(folder / "probes.toml")
        << "[[probe]]\nnode = 1\nangle = \"0 deg\"\nchannel = 1\n";
  }
};

/// Stays in a folder for as long as it lives.
struct Visit {
  explicit Visit(const fs::path& folder) { fs::current_path(folder); }
  ~Visit() { fs::current_path(before); }
  fs::path before = fs::current_path();
};

bool asks_for_much(const std::string& word) {
  constexpr int most_digits = 3;
  int digits = 0;
  for (const char c : word) {
    digits = std::isdigit(static_cast<unsigned char>(c)) != 0 ? digits + 1 : 0;
    if (digits > most_digits || c == '/') return true;
  }
  return word.find("e") != std::string::npos &&
         word.find_first_of("0123456789") < word.rfind('e') &&
         std::isdigit(static_cast<unsigned char>(word.back())) != 0;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> words{"whirl"};
  for (std::string word; std::getline(lines, word);) {
    if (!asks_for_much(word) && word.find('\0') == std::string::npos) words.push_back(word);
  }
  return words;
}

void run(const Verb& verb, const std::vector<std::string>& words) {
  if (verb.run_words) {
    verb.run_words({words.begin() + 2, words.end()}, nullptr);
    return;
  }
  auto read = cli::read_command_line(verb, words, {});
  cli::CommandLine* const line = std::get_if<cli::CommandLine>(&read);
  if (!line) return;
  line->call.is_stopped = [] { return true; };
  line->call.progress = [](const std::string&, long, long) {};
  line->call.prepare();
  verb.run.with(line->call);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::vector<std::string> words =
      words_of(std::string(reinterpret_cast<const char*>(data), size));
  const Verb* const verb = words.size() > 1 ? verb_named(words[1]) : nullptr;
  // a film starts another program, a run again runs whole
  if (!verb || verb->name == "animate" || verb->name == "rerun") return 0;
  const Visit visit(folder.folder);
  try {
    run(*verb, words);
  } catch (const ModelError&) {
  } catch (const FileError&) {
  } catch (const NumericalError&) {
  } catch (const std::bad_alloc&) {
  }
  return 0;
}
