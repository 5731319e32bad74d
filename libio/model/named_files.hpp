#pragma once

#include <filesystem>
#include <utility>

#include "libio/model/foreign_table.hpp"

namespace whirl::inline io {

/// Files with tables that a model may name, and where they are.
///
/// A model that is stored in a result has its tables in it. Whoever reads a stranger's result must
/// not open what a name in it leads to: no file, and no device or pipe, either.
struct NamedFiles {
  /// No files.
  NamedFiles() = default;
  /// All files that are named by the text of the model, and by what is set in it.
  /// @param where  the folder that the names are relative to
  NamedFiles(std::filesystem::path where)  // NOLINT: a folder says it
      : folder(std::move(where)), of_text(true), of_sets(true) {}
  NamedFiles(const char* where) : NamedFiles(std::filesystem::path(where)) {}
  /// For a stored model: only files that PATH=VALUE lines name, which somebody gives at the command
  /// line.
  static NamedFiles of_sets_in(std::filesystem::path where) {
    NamedFiles files(std::move(where));
    files.of_text = false;
    return files;
  }
  /// No files; the folder is for the motion that a model starts from.
  static NamedFiles none_in(std::filesystem::path where) {
    NamedFiles files = of_sets_in(std::move(where));
    files.of_sets = false;
    return files;
  }

  /// The same files, and those of other programs, too.
  NamedFiles with(ConvertFile how) const {
    NamedFiles files = *this;
    files.convert = how;
    return files;
  }

  std::filesystem::path folder{};
  bool of_text = false, of_sets = false;
  /// Makes tables of files of other programs; null: such files are refused.
  ConvertFile convert = nullptr;
};

}  // namespace whirl::inline io
