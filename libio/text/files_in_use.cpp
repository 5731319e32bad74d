#include "libio/text/files_in_use.hpp"

#include <fmt/format.h>

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

thread_local FilesInUse* list_of_call = nullptr;
thread_local int looks = 0;

}  // namespace

fs::path behind_links(const fs::path& path) {
  constexpr int most = 40;  // as the system follows
  fs::path place = path;
  std::error_code problem;
  for (int links = 0; fs::is_symlink(place, problem); ++links) {
    if (links == most) return {};
    const fs::path target = fs::read_symlink(place, problem);
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;  // no names
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const auto whole = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(behind_links(path), ignored), ignored);
  };
  return whole(a) == whole(b);
}

FilesInUse::FilesInUse() : is_first_(!list_of_call) {
  if (is_first_) list_of_call = this;
}

FilesInUse::~FilesInUse() {
  if (is_first_) list_of_call = nullptr;
}

const FilesInUse::Use* FilesInUse::reading(const fs::path& place) const {
  for (const Use& use : read_) {
    if (is_same_file(use.place, place)) return &use;
  }
  return nullptr;
}

LooksAtOutput::LooksAtOutput() {
  ++looks;
}

LooksAtOutput::~LooksAtOutput() {
  --looks;
}

std::string problem_of_reading(const fs::path& file, std::string_view by) {
  if (!list_of_call || looks > 0 || file.empty()) return "";
  for (const FilesInUse::Use& use : list_of_call->outputs_) {
    if (is_same_file(use.place, file)) return use.by + " would replace it";
  }
  if (!list_of_call->reading(file)) list_of_call->read_.push_back({file, std::string(by)});
  return "";
}

std::string problem_of_output(const fs::path& place, const std::string& option, bool is_last) {
  if (!list_of_call || place.empty()) return "";
  if (const auto* use = list_of_call->reading(place)) return use->by;
  for (const FilesInUse::Use& use : list_of_call->outputs_) {
    if (is_same_file(use.place, place)) {
      return fmt::format("{} and {} name the same file", use.by, option);
    }
  }
  list_of_call->outputs_.push_back({place, option, is_last});
  return "";
}

std::string problem_of_writing(const fs::path& place) {
  if (!list_of_call) return "";
  if (const auto* use = list_of_call->reading(place)) return use->by;
  for (const FilesInUse::Use& use : list_of_call->outputs_) {
    if (use.is_last && is_same_file(use.place, place)) return use.by + " names this file, too";
  }
  return "";
}

void begin_last_output(const fs::path& place) {
  if (!list_of_call) return;
  for (FilesInUse::Use& use : list_of_call->outputs_) {
    if (use.is_last && is_same_file(use.place, place)) use.is_last = false;
  }
}

}  // namespace whirl::inline io
