#pragma once

#include <filesystem>
#include <utility>

namespace whirl::inline io {

/// Files with tables that a model may name, and where they are.
///
/// A model that is stored in a result has its tables in it. Who reads a stranger's result must not
/// open what a name in there leads to: no file, and no device or pipe, either.
struct NamedFiles {
  /// None.
  NamedFiles() = default;
  /// All that the text of the model names, and what is set in it.
  /// @param where  the folder that the names are of
  NamedFiles(std::filesystem::path where)  // NOLINT: a folder says it
      : folder(std::move(where)), of_text(true), of_sets(true) {}
  NamedFiles(const char* where) : NamedFiles(std::filesystem::path(where)) {}
  /// Only those that PATH=VALUE lines name, which somebody gives at the command line: of a stored
  /// model.
  static NamedFiles of_sets_in(std::filesystem::path where) {
    NamedFiles files(std::move(where));
    files.of_text = false;
    return files;
  }
  /// None; the folder is that of a motion to start from.
  static NamedFiles none_in(std::filesystem::path where) {
    NamedFiles files = of_sets_in(std::move(where));
    files.of_sets = false;
    return files;
  }

  std::filesystem::path folder{};
  bool of_text = false, of_sets = false;
};

}  // namespace whirl::inline io
