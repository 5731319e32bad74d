#include "libio/results/command_files.hpp"

#include <fmt/format.h>

namespace whirl::inline io {

namespace {

[[noreturn]] void refuse_place(const std::string& place, std::string_view reason) {
  throw FileError(fmt::format("cannot write {}: {}", place, reason));
}

void require_no_input(const CommandFiles& files, const std::string& place) {
  if (!files.input.empty() && is_same_file(place, files.input)) {
    refuse_place(place, "it is the input of this command");
  }
  for (const std::string& other : files.others) {
    if (is_same_file(place, other)) refuse_place(place, "this command reads it");
  }
}

}  // namespace

void require_free_places(const CommandFiles& files) {
  const auto require_place = [&](const std::string& place, Replaces what) {
    FileReplacement{place, files.is_forced ? Replaces::anything : what};
  };
  const std::string& out = files.out;
  if (!out.empty() && files.out_kind == OutKind::result) {
    require_place(out, Replaces::own_results);
  }
  if (!out.empty() && files.out_kind != OutKind::stem) require_no_input(files, out);
  if (files.svg) {
    require_no_input(files, *files.svg);
    require_place(*files.svg, Replaces::own_pictures);
  }
  const std::string& json = files.json;
  if (json.empty()) return;
  require_no_input(files, json);
  if (!files.from.empty() && is_same_file(json, files.from)) {
    refuse_place(json, "--from reads it");
  }
  if (!out.empty() && is_same_file(json, out)) {
    refuse_place(json, "--out and --json name the same file");
  }
  require_place(json, Replaces::own_pictures);
}

}  // namespace whirl::inline io
