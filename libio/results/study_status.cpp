#include "libio/results/study_status.hpp"

#include <fmt/format.h>
#include <limits.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <span>

#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/curve_result.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/torus_result.hpp"
#include "libio/results/call.hpp"
#include "libio/results/row_journal.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/results/study_part.hpp"

namespace whirl::inline io {

namespace {

std::string own_host() {
  char name[HOST_NAME_MAX + 1] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

/// Whether a process of this machine is there, and of this program, by the name that Linux keeps.
bool is_alive(int process) {
  if (process <= 0 || (::kill(process, 0) != 0 && errno == ESRCH)) return false;
  std::string name;
  std::ifstream file(fmt::format("/proc/{}/comm", process));
  return !std::getline(file, name) || name.starts_with("whirl");
}

/// Counts the points of a grid.
/// @param stripe  those that count
/// @return  false: the file has none
bool count_grid(const ResultReader& file, const Stripe& stripe, StudyStatus& status) {
  for (const std::string_view name : {MapResult::group, SweepResult::group, BasinsResult::group}) {
    const std::string group(name);
    const std::size_t points = study_columns::stored_points(file, group);
    if (points == 0) continue;
    std::vector<bool> done = study_columns::read_done(file, group, points);
    status.points = static_cast<long>(stripe.points(points));
    status.failed = 0;
    std::size_t i = 0;
    file.each_block(group + "/motion", [&](std::span<const double> motions) {
      for (const double motion : motions) {
        if (!done[i++]) continue;
        ++status.done;
        if (motion < 0.0) ++*status.failed;
      }
    });
    for (const std::uint64_t row : rows_in_journal(journal_of(file.path()))) {
      if (row >= points || done[row]) continue;
      done[row] = true;
      ++status.done;
    }
    return true;
  }
  return false;
}

/// Counts the points along branches or circles.
/// @return  false: the file has none
bool count_walk(const ResultReader& file, StudyStatus& status) {
  for (const std::string_view name : {BranchResult::group, TorusResult::group}) {
    const std::string group(name);
    if (!file.has(group)) continue;
    if (!file.has(group + "/value")) return true;
    const std::vector<Eigen::Index> shape = file.shape(group + "/value");
    if (shape.size() != 1) {
      throw FileError(fmt::format("{}: {}/value is damaged or of another program",
                                  file.path().string(), group));
    }
    status.done = shape[0];
    return true;
  }
  return false;
}

}  // namespace

bool says_complete(const ResultReader& file) {
  for (const std::string_view group :
       {MapResult::group, SweepResult::group, BasinsResult::group, BranchResult::group,
        CurveResult::group, TorusResult::group}) {
    const std::string name(group);
    if (file.has(name) && file.has_attribute(name, "complete") &&
        file.number_attribute(name, "complete") == 0.0) {
      return false;
    }
  }
  return true;
}

StudyWork this_work(double seconds) {
  return {.seconds = seconds, .host = own_host(), .process = static_cast<int>(::getpid())};
}

void write_work(ResultWriter& file, const StudyWork& work) {
  file.attribute("/", "seconds", work.seconds);
  file.attribute("/", "host", work.host);
  file.attribute("/", "process", work.process);
}

std::optional<StudyWork> read_work(const ResultReader& file) {
  for (const char* name : {"seconds", "host", "process"}) {
    if (!file.has_attribute("/", name)) return std::nullopt;
  }
  const double process = file.number_attribute("/", "process");
  const bool is_number = process >= 0.0 && process <= std::numeric_limits<int>::max();
  return StudyWork{.seconds = file.number_attribute("/", "seconds"),
                   .host = file.string_attribute("/", "host"),
                   .process = is_number ? static_cast<int>(process) : 0};
}

StudyStatus study_status(const std::filesystem::path& path) {
  const ResultReader file(path);
  const Call call = read_call(file);
  const Stripe stripe = stripe_of(call);
  StudyStatus status{.file = path.string(), .verb = call.verb};
  if (!count_grid(file, stripe, status) && !count_walk(file, status)) {
    throw FileError(fmt::format("{} holds no study, but what whirl {} found", status.file,
                                status.verb.empty() ? "otherwise" : status.verb));
  }
  if (file.has_attribute("/", "created")) status.saved = file.string_attribute("/", "created");
  // a part never says so
  status.is_complete = (!stripe.is_all() || says_complete(file)) &&
                       (!status.points || status.done == *status.points);
  status.work = read_work(file);
  if (status.is_complete) {
    status.is_running = false;
  } else if (status.work && status.work->host == own_host()) {
    status.is_running = is_alive(status.work->process);
  }
  if (!status.work || !(status.work->seconds > 0.0) || status.done == 0) return status;
  status.rate = static_cast<double>(status.done) / status.work->seconds;
  if (status.points) status.left = static_cast<double>(*status.points - status.done) / *status.rate;
  return status;
}

}  // namespace whirl::inline io
