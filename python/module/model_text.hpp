#pragma once
/// A model as Python has it: its text, what was set of it since, and what comes of both.

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/model/config.hpp"

namespace whirl::inline python {

class ModelText {
 public:
  /// @param file    for messages, and in whose folder other files are looked for
  /// @param text    TOML
  /// @param stored  whether the text is one that a result holds, for which no file is opened
  /// @throws ModelError  with all problems
  ModelText(std::string file, std::string text, std::vector<std::string> sets, bool stored = false);

  /// A copy in which more is set: "PATH=VALUE" lines as of --set, which hold together or not at
  /// all.
  ModelText with(const std::vector<std::string>& sets) const;

  /// The value at a path, as it is written: text, number, truth, list or dict.
  /// @throws ModelError  if there is none
  pybind11::object value(const std::string& path) const;

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }  ///< as it was read
  const std::vector<std::string>& sets() const { return sets_; }
  const std::shared_ptr<const Model>& made() const { return made_; }

  /// M, C, G, K at its speed as (data, row numbers, column starts) each, names of the coordinates
  /// and where they are.
  pybind11::dict matrices() const;

 private:
  std::string file_, text_;
  std::vector<std::string> sets_;
  bool is_stored_;
  std::shared_ptr<const Model> made_;
};

}  // namespace whirl::inline python
