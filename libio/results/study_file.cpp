#include "libio/results/study_file.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/system/arithmetic.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/call.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/results/study_part.hpp"
#include "libio/results/study_status.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace {

constexpr int rarely = 100;       ///< times what it takes, until a whole file is written again
constexpr int first_of_run = 10;  ///< likewise, in a run that goes on with one

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

/// What is said of a file that was computed with arithmetic that rounds otherwise; empty: it does
/// not, or the file is of an early version, which did not tell.
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

/// Takes over what an earlier run of a call has left in a file.
/// @param otherwise  what to do where the file is not that
void resume(const StudyPlace& place, const std::filesystem::path& from, const Call& call,
            std::string_view otherwise, const std::function<void(const ResultReader&)>& take) {
  const ResultReader earlier(from);
  const auto refuse = [&](const std::string& why) {
    throw FileError(fmt::format("{} {}; {}", from.string(), why, otherwise));
  };
  if (!earlier.has("/arguments") || !earlier.has("/model")) refuse("is no study of whirl");
  if (essential(without_part(read_call(earlier))) != essential(without_part(call))) {
    refuse("holds another study: " + earlier.string_attribute("/", "command"));
  }
  if (stored_model(earlier) != place.model) {
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
    const bool is_number =
        problem == std::errc{} && (end == name.data() + name.size() || *end == '.');
    if (is_number && ::kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

void write_start(ResultWriter& file, const StudyPlace& place) {
  if (!place.start) return;
  const EarlierEnd& start = *place.start;
  StudyStart from{start.state.displacement, start.state.velocity, start.phase};
  if (start.revolution != 0) from.revolution = static_cast<double>(start.revolution);
  write_result(file, from);
}

StudyFile::StudyFile(StudyPlace place, Begin begin, std::function<void(ResultWriter&)> write,
                     const std::function<void(const ResultReader&)>& take,
                     std::function<bool()> is_stopped)
    : place_(std::move(place)),
      begin_(std::move(begin)),
      write_(std::move(write)),
      is_stopped_(std::move(is_stopped)) {
  if (place_.file.empty()) return;
  remove_leftovers(place_.file);
  begin_();  // says at once what cannot be written
  const bool goes_on = !place_.restarts && origin_of(place_.file) == Origin::result;
  if (goes_on) {
    const auto since = clock::now();
    const LooksAtOutput look;
    resume(place_, place_.file, place_.call, "take another name, or --restart to replace it",
           [&](const ResultReader& earlier) {
             if (const auto work = read_work(earlier)) seconds_before_ = work->seconds;
             take(earlier);
           });
    cost_ = clock::now() - since;  // writing takes about as long as reading
    next_whole_ = clock::now() + first_of_run * cost_;
  } else if (place_.restarts) {
    drop_rows(journal_of(place_.file));
  } else if (std::filesystem::exists(journal_of(place_.file))) {
    journal().clear();  // whoever takes the file of this study away means all of it
  }
  for (const std::string& part : place_.joins) {
    resume(place_, part, place_.call, "it is no part of this study", take);
    if (rows_in_journal(journal_of(part)).empty()) continue;
    throw FileError(fmt::format(
        "{} has rows beside it that are not in it yet: `whirl merge {}` puts them there", part,
        shell_word(part)));
  }
}

std::string StudyFile::key() const {
  std::string key = place_.version + '\n' + place_.model;
  for (const std::string& word : essential(place_.call)) key += '\n' + word;
  return key;
}

RowJournal& StudyFile::journal() {
  if (!journal_) journal_.emplace(journal_of(place_.file), key());
  return *journal_;
}

bool StudyFile::is_dear() const {
  return cost_ > std::chrono::milliseconds(50);
}

void StudyFile::take_rows(const RowJournal::ReadRow& f) {
  const std::filesystem::path place = journal_of(place_.file);
  if (place_.file.empty() || journal_ || !std::filesystem::exists(place)) return;
  journal_.emplace(place, key(), f);
}

void StudyFile::add(std::span<const std::size_t> points,
                    const std::function<std::string(std::size_t point)>& pack) {
  if (place_.file.empty()) return;
  is_current_ = false;
  if (journal_ || is_dear()) {
    std::vector<RowJournal::Row> rows;
    for (const std::size_t point : points) rows.push_back({point, pack(point)});
    journal().append(rows);
    if (clock::now() < next_whole_) return;
  }
  save();
  is_current_ = true;
}

bool StudyFile::is_given_up(clock::time_point since) const {
  const bool is_late =
      journal_ && cost_ > clock::duration::zero() && clock::now() - since > place_.patience;
  return is_late && is_stopped_ && is_stopped_();
}

void StudyFile::save() {
  if (place_.file.empty() || std::exchange(is_current_, false)) return;
  const auto begin = clock::now();
  if (is_given_up(begin - cost_)) return;
  const auto file = begin_();
  file->give_up_if([&] { return is_given_up(begin); });
  write_start(*file, place_);
  try {
    write_(*file);
  } catch (const WritingGivenUp&) {
    return;
  }
  const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begun_;
  write_work(*file, this_work(seconds_before_ + now.count()));
  file->commit();
  cost_ = clock::now() - begin;
  next_whole_ = clock::now() + rarely * cost_;
  if (journal_) journal_->clear();
}

void StudyFile::finish() {
  if (journal_ && journal_->is_empty()) journal_->remove();
}

}  // namespace whirl::inline io
