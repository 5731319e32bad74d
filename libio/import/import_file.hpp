#pragma once
/// Models from files of other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// What an import wrote.
struct Imported {
  Model model;                                 ///< as it is read from the written files
  std::vector<std::string> files;              ///< the model's first
  std::vector<std::string> left_out;           ///< what the model does not have
  std::vector<std::string> taken_differently;  ///< what means something else in the model
};

/// Writes a rotor saved by ROSS, TOML or JSON, as a model, and its tables beside it.
/// @param place     of the model; tables are named after it
/// @param replaces  what may be lost there
/// @throws ModelError  if the file is none of ROSS's, or wrong; with the places of all problems
/// @throws FileError   if it cannot be read, or a place is taken
Imported import_file(const std::filesystem::path& file, const std::filesystem::path& place,
                     Replaces replaces);

}  // namespace whirl::inline io
