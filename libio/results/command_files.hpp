#pragma once
/// The files of a command, looked at before its work: what it writes replaces nothing that is needed.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// What is at the place of --out.
enum class OutKind {
  result,   ///< a result file
  picture,  ///< a picture, video or page, whose writer looks at its place itself
  stem      ///< where names of files begin
};

/// Files that a command reads and writes; empty or nothing: it has none of a kind.
struct CommandFiles {
  std::string input{};                ///< the model or result that it is about
  std::vector<std::string> others{};  ///< that it reads, too
  std::string from{};                 ///< the result that it goes on from
  std::string out{};
  OutKind out_kind = OutKind::result;
  std::optional<std::string> svg{};
  std::string json{};
  bool is_forced = false;  ///< it may replace what this program did not write
};

/// Checks that results take the place of nothing but results, and of nothing that is read, which is
/// not to be lost in any case.
/// @throws FileError  naming what would be lost: the input, another file, the other result
void require_free_places(const CommandFiles& files);

}  // namespace whirl::inline io
