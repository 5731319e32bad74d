#include "libio/results/study_file.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cerrno>
#include <charconv>
#include <filesystem>

#include "libbase/arithmetic.hpp"
#include "libbase/error.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/results/study_status.hpp"

namespace whirl::inline io {

namespace {

/// The parts of a call that change what is computed; the model is compared as a text.
std::vector<std::string> essential(const Call& call) {
  std::vector<std::string> kept{call.verb, call.file};
  kept.insert(kept.end(), call.words.begin(), call.words.end());
  const std::vector<std::string> options = options_without(
      call.options, {"out", "json", "svg", "threads", "isa", "quiet", "restart", "force"});
  kept.insert(kept.end(), options.begin(), options.end());
  return kept;
}

/// Where the motion began that was taken from another file, as it was written into a study.
bool is_same_start(const ResultReader& file, const EarlierEnd& start) {
  if (!file.has("/from/displacement")) return true;  // of an early version, which did not keep it
  const auto then = read_result<StudyStart>(file);
  const auto is_same = [](const Vec& a, const Vec& b) { return a.size() == b.size() && a == b; };
  return is_same(then.displacement, start.state.displacement) &&
         is_same(then.velocity, start.state.velocity) && then.phase == start.phase &&
         then.revolution.value_or(0.0) == static_cast<double>(start.revolution);
}

/// What is said of a file that was computed with arithmetic that rounds otherwise; empty: it does not,
/// or the file is of an early version, which did not tell.
std::string other_arithmetic(const ResultReader& file) {
  if (!file.has_attribute("/", "instruction_set")) return "";
  const std::string set = file.string_attribute("/", "instruction_set"), own = instruction_set();
  if (!rounds_alike(set, own)) {
    return fmt::format("was begun with the instruction set {}, this is {}: see --isa", set, own);
  }
  const std::string then = file.string_attribute("/", "mathematics"), now = mathematics();
  if (then == now) return "";
  return fmt::format("was begun with other mathematical functions ({}, these are {})", then, now);
}

/// Takes over what an earlier run of the same line has left in its file.
void resume(const StudyPlace& place, const std::function<void(const ResultReader&)>& take) {
  const ResultReader earlier(place.file);
  const auto refuse = [&](const std::string& why) {
    throw FileError(
        fmt::format("{} {}; take another name, or --restart to replace it", place.file, why));
  };
  if (!earlier.has("/arguments") || !earlier.has("/model")) refuse("is no study of whirl");
  if (essential(read_call(earlier)) != essential(place.call)) {
    refuse("holds another study: " + earlier.string_attribute("/", "command"));
  }
  if (earlier.strings("/model").at(0) != place.model) {
    refuse("holds this study of a model that has changed since");
  }
  if (place.start && !is_same_start(earlier, *place.start)) {
    refuse(
        fmt::format("holds this study from another start: {} has changed since", place.start_file));
  }
  if (earlier.string_attribute("/", "whirl_version") != place.version) {
    refuse("was begun by whirl " + earlier.string_attribute("/", "whirl_version"));
  }
  if (const std::string why = other_arithmetic(earlier); !why.empty()) refuse(why);
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

StudyFile::StudyFile(StudyPlace place, Begin begin, std::function<void(ResultWriter&)> write,
                     const std::function<void(const ResultReader&)>& take)
    : place_(std::move(place)), begin_(std::move(begin)), write_(std::move(write)) {
  if (place_.file.empty()) return;
  remove_leftovers(place_.file);
  begin_();  // says at once what cannot be written
  if (place_.restarts || origin_of(place_.file) != Origin::result) return;
  resume(place_, [&](const ResultReader& earlier) {
    if (const auto work = read_work(earlier)) seconds_before_ = work->seconds;
    take(earlier);
  });
}

void StudyFile::save() {
  if (place_.file.empty()) return;
  const auto file = begin_();
  if (const auto& start = place_.start) {
    StudyStart from{start->state.displacement, start->state.velocity, start->phase};
    if (start->revolution != 0) from.revolution = static_cast<double>(start->revolution);
    write_result(*file, from);
  }
  write_(*file);
  const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begun_;
  write_work(*file, this_work(seconds_before_ + now.count()));
  file->commit();
}

}  // namespace whirl::inline io
