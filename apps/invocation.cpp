#include <fmt/format.h>

#include <charconv>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "apps/verb.hpp"
#include "apps/version.hpp"
#include "libio/hdf5.hpp"
#include "libio/model_file.hpp"
#include "libio/replace_file.hpp"
#include "libio/units.hpp"
#include "libio/value_range.hpp"

namespace whirl {

namespace {

constexpr double rpm = 3.14159265358979323846 / 30.0;
constexpr int default_speeds = 101;

ModelError option_error(const std::string& option, const std::string& value, std::string message) {
  return ModelError({fmt::format("--{} {}", option, value)}, "", std::move(message));
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

/// The command line as a shell would take it.
std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool is_plain =
        !word.empty() && word.find_first_of(" \t\n\"'\\$`*?[]{}()<>|&;#~!") == std::string::npos;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += (line.empty() ? "" : " ") + (is_plain ? word : quoted + "'");
  }
  return line;
}

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(a), ignored) ==
             fs::weakly_canonical(fs::absolute(b), ignored) ||
         fs::equivalent(a, b, ignored);
}

/// Whether a file is there that has something in it and is not what its name's ending says: a
/// picture or page that this program writes, else HDF5.
bool holds_something_else(const fs::path& place) {
  std::error_code ignored;
  if (!fs::is_regular_file(place, ignored)) return false;
  char begin[4] = {};
  std::ifstream(place, std::ios::binary).read(begin, sizeof begin);
  const std::string ending = place.extension();
  const std::string_view expected = ending == ".svg"    ? "<?xm"
                                    : ending == ".png"  ? "\x89PNG"
                                    : ending == ".pdf"  ? "%PDF"
                                    : ending == ".html" ? "<!DO"
                                    : ending == ".ogv"  ? "OggS"
                                    : ending == ".gif"  ? "GIF8"
                                                        : "\x89HDF";
  return begin[0] != '\0' && std::string_view(begin, sizeof begin) != expected;
}

}  // namespace

std::string Invocation::text(const std::string& option, const std::string& otherwise) const {
  const auto found = given.find(option);
  return found == given.end() ? otherwise : found->second;
}

long Invocation::integer(const std::string& option, long otherwise, long least) const {
  if (!has(option)) return otherwise;
  const std::string& value = given.at(option);
  long number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  constexpr long most = 1'000'000'000;
  if (error != std::errc{} || end != value.data() + value.size() || number < least ||
      number > most) {
    throw option_error(option, value, fmt::format("expected a whole number of {} or more", least));
  }
  return number;
}

double Invocation::number(const std::string& option, std::string_view unit,
                          double otherwise) const {
  if (!has(option)) return otherwise;
  const auto value = parse_as(given.at(option), unit);
  if (!value) throw option_error(option, given.at(option), value.problem);
  return *value;
}

std::vector<double> Invocation::speeds(const Model& model) const {
  if (has("speeds")) {
    const auto range = parse_range(given.at("speeds"), "rad/s");
    if (!range) throw option_error("speeds", given.at("speeds"), range.problem);
    if (range->first < 0.0)
      throw option_error("speeds", given.at("speeds"), "expected speeds of zero or more");
    return range->step ? values(*range) : values(*range, default_speeds);
  }
  const double last = model.speed > 0.0 ? 1.5 * model.speed : 10'000.0 * rpm;
  return values(ValueRange{0.0, last, {}}, default_speeds);
}

Model Invocation::model() const {
  if (model_text.empty()) return read_model(file, sets);
  return parse_model(model_text, file, sets, std::filesystem::path(file).parent_path());
}

void Invocation::require_free_places(const std::string& json) const {
  const auto refuse = [](const std::string& place, std::string_view reason) {
    throw FileError(fmt::format("cannot write {}: {}", place, reason));
  };
  const std::string out = text("out");
  if (!out.empty() && holds_something_else(out)) {
    refuse(out, "this file is no result of whirl and would be lost; take another name");
  }
  if (json.empty() || json == "-") return;
  if (is_same_file(json, file)) refuse(json, "it is the input of this command");
  if (has("from") && is_same_file(json, text("from"))) refuse(json, "--from reads it");
  if (!out.empty() && is_same_file(json, out)) refuse(json, "--out and --json name the same file");
  FileReplacement{json};  // a directory that is not there is said before the work
}

std::unique_ptr<ResultWriter> Invocation::result_file(const Model& model) const {
  if (!has("out")) return nullptr;
  auto writer = std::make_unique<ResultWriter>(given.at("out"));
  writer->attribute("/", "whirl_version", version);
  writer->attribute("/", "command", shell_line(line));
  writer->attribute("/", "created", utc_now());
  writer->attribute("/", "title", model.title);
  writer->dataset("/model", std::vector<std::string>{model.source}, {"", "model file", {""}});
  writer->attribute("/model", "path", model.path);
  writer->dataset("/arguments", line, {"", "words of the command line", {""}});
  return writer;
}

}  // namespace whirl
