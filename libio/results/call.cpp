#include "libio/results/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <map>

#include "libbase/system/arithmetic.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::inline io {

namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

const std::string call_group = "/call";

/// Options that took no value when files held the words of a command line only.
constexpr std::array flag_options{"quiet",     "restart",       "fresh",     "confirm",
                                  "rotations", "mass-weighted", "stiffened", "verify"};

bool is_flag(std::string_view name) {
  return std::find(flag_options.begin(), flag_options.end(), name) != flag_options.end();
}

std::vector<std::string> filtered(const std::vector<std::string>& options,
                                  const std::vector<std::string_view>& names, bool keeps) {
  std::vector<std::string> kept;
  for (const std::string& option : options) {
    const bool is_named = std::find(names.begin(), names.end(), option_name(option)) != names.end();
    if (is_named == keeps) kept.push_back(option);
  }
  return kept;
}

}  // namespace

std::string option_name(std::string_view option) {
  if (option.starts_with("--")) option.remove_prefix(2);
  return std::string(option.substr(0, option.find('=')));
}

std::vector<std::string> options_named(const std::vector<std::string>& options,
                                       const std::vector<std::string_view>& names) {
  return filtered(options, names, true);
}

std::vector<std::string> options_without(const std::vector<std::string>& options,
                                         const std::vector<std::string_view>& names) {
  return filtered(options, names, false);
}

std::vector<std::string> words_again(const std::string& program, const Call& call,
                                     std::vector<std::string_view> left_out) {
  left_out.insert(left_out.end(), {"quiet", "force", "restart", "set", "speed"});
  std::vector<std::string> words{program, call.verb, call.file};
  for (const std::string& option : options_without(call.options, left_out)) {
    words.push_back(option);
  }
  return words;
}

Call parse_call(const std::vector<std::string>& words) {
  Call call{.verb = words.size() > 1 ? words[1] : "", .file = ""};
  std::map<std::string, std::string> last;  // of options that are given once
  std::vector<std::string> over, speed;
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (!word.starts_with("--")) {
      if (call.file.empty()) {
        call.file = word;
      } else {
        call.words.push_back(word);
      }
      continue;
    }
    const std::string name = option_name(word);
    const auto equals = word.find('=');
    std::string value;
    if (equals != std::string::npos) {
      value = word.substr(equals + 1);
    } else if (!is_flag(name) && i + 1 < words.size()) {
      value = words[++i];
    }
    if (name == "set") {
      call.sets.push_back(value);
    } else if (name == "speed") {
      speed = {"operation.speed=" + value};
    } else if (name == "over") {
      over.push_back("--over=" + value);
    } else {
      last[name] = is_flag(name) ? "--" + name : "--" + name + "=" + value;
    }
  }
  call.sets.insert(call.sets.end(), speed.begin(), speed.end());
  call.options = over;
  for (const auto& [name, option] : last) call.options.push_back(option);
  return call;
}

void write_call(ResultWriter& file, const Call& call) {
  file.attribute(call_group, "verb", call.verb);
  file.attribute(call_group, "file", call.file);
  const auto write = [&](const char* name, const char* what,
                         const std::vector<std::string>& texts) {
    if (!texts.empty()) file.dataset(call_group + '/' + name, texts, {"", what, {""}});
  };
  write("word", "words after the file", call.words);
  write("set", "what was set of the model", call.sets);
  write("option", "all other options", call.options);
}

Call read_call(const ResultReader& file) {
  if (!file.has(call_group)) return parse_call(file.strings("/arguments"));
  const auto read = [&](const char* name) {
    const std::string path = call_group + '/' + name;
    return file.has(path) ? file.strings(path) : std::vector<std::string>{};
  };
  return {.verb = file.string_attribute(call_group, "verb"),
          .file = file.string_attribute(call_group, "file"),
          .words = read("word"),
          .sets = read("set"),
          .options = read("option")};
}

void write_origin(ResultWriter& file, const ResultOrigin& origin, const Model& model) {
  file.attribute("/", "whirl_version", std::string(origin.version));
  file.attribute("/", "format", result_format);
  file.attribute("/", "command", shell_line(origin.line));
  file.attribute("/", "instruction_set", instruction_set());
  file.attribute("/", "mathematics", mathematics());
  file.attribute("/", "created", utc_now());
  file.attribute("/", "title", model.title);
  file.dataset("/model", std::vector<std::string>{model.source}, {"", "model file", {""}});
  file.attribute("/model", "path", model.path);
  file.dataset("/arguments", origin.line, {"", "words of the command line", {""}});
  write_call(file, origin.call);
}

std::string stored_model(const ResultReader& file) {
  const std::vector<std::string> texts = file.strings("/model");
  if (texts.size() == 1) return texts.front();
  throw FileError(fmt::format("{}: /model is damaged or of another program: expected one text",
                              file.path().string()));
}

std::string shell_word(std::string_view word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+@%-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace whirl::inline io
