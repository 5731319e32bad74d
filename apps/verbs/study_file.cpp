#include "apps/verbs/study_file.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cerrno>
#include <charconv>
#include <filesystem>

#include "apps/verbs/common.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::inline cli {

namespace {

/// The parts of a call that change what is computed; the model is compared as a text.
std::vector<std::string> essential(const Call& call) {
  std::vector<std::string> kept{call.verb, call.file};
  kept.insert(kept.end(), call.words.begin(), call.words.end());
  const std::vector<std::string> options =
      options_without(call.options, {"out", "json", "svg", "threads", "quiet", "restart", "force"});
  kept.insert(kept.end(), options.begin(), options.end());
  return kept;
}

/// Where the motion began that was taken from another file, as it was written into a study.
bool is_same_start(const ResultReader& file, const EarlierEnd& start) {
  if (!file.has("/from/displacement")) return true;  // of an early version, which did not keep it
  const auto then = read_result<StudyStart>(file);
  const auto is_same = [](const Vec& a, const Vec& b) { return a.size() == b.size() && a == b; };
  return is_same(then.displacement, start.state.displacement) &&
         is_same(then.velocity, start.state.velocity) && then.phase == start.phase;
}

/// Takes over what an earlier run of the same line has left in its file.
void resume(const Invocation& call, const std::optional<EarlierEnd>& start,
            const std::function<void(const ResultReader&)>& take) {
  const std::string& place = call.given.at("out");
  const ResultReader earlier(place);
  const auto refuse = [&](const std::string& why) {
    throw FileError(
        fmt::format("{} {}; take another name, or --restart to replace it", place, why));
  };
  if (!earlier.has("/arguments") || !earlier.has("/model")) refuse("is no study of whirl");
  if (essential(read_call(earlier)) != essential(call.parts())) {
    refuse("holds another study: " + earlier.string_attribute("/", "command"));
  }
  if (earlier.strings("/model").at(0) != call.model().source) {
    refuse("holds this study of a model that has changed since");
  }
  if (start && !is_same_start(earlier, *start)) {
    refuse(fmt::format("holds this study from another start: {} has changed since",
                       call.text_or("from", call.model().start.file)));
  }
  if (earlier.string_attribute("/", "whirl_version") != version) {
    refuse("was begun by whirl " + earlier.string_attribute("/", "whirl_version"));
  }
  check_result(earlier);
  take(earlier);
}

/// Removes what killed runs have left beside a file.
void remove_leftovers(const std::filesystem::path& place) {
  namespace fs = std::filesystem;
  const std::string begin = place.filename().string() + ".tmp.";
  const fs::path folder = place.has_parent_path() ? place.parent_path() : ".";
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin)) continue;
    int process = 0;
    const char* number = name.data() + begin.size();
    const auto [end, problem] = std::from_chars(number, name.data() + name.size(), process);
    const bool is_number = problem == std::errc{} && end == name.data() + name.size();
    if (is_number && ::kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

std::optional<EarlierEnd> earlier_start(const Invocation& call, const Model& model) {
  if (!call.has("from") && model.start.from != StartFrom::file) return std::nullopt;
  return earlier_end(call.text_or("from", model.start.file));
}

void write_start(ResultWriter& file, const std::optional<EarlierEnd>& start) {
  if (!start) return;
  write_result(file, StudyStart{start->state.displacement, start->state.velocity, start->phase});
}

StudyFile::StudyFile(const Invocation& call, const std::optional<EarlierEnd>& start, Begin begin,
                     std::function<void(ResultWriter&)> write,
                     const std::function<void(const ResultReader&)>& take)
    : has_file_(call.has("out")), begin_(std::move(begin)), write_(std::move(write)) {
  if (!has_file_) return;
  const std::string& place = call.given.at("out");
  remove_leftovers(place);
  begin_();  // says at once what cannot be written
  if (!call.has("restart") && origin_of(place) == Origin::result) resume(call, start, take);
}

void StudyFile::save() {
  if (!has_file_) return;
  const auto file = begin_();
  write_(*file);
  file->commit();
}

}  // namespace whirl::inline cli
