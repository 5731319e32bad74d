#pragma once
/// Model files: from TOML to a checked model.

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libio/model/named_files.hpp"

namespace whirl::inline io {

/// Reads a model file and everything it names (tables of bearings, of the shaft, of its bow).
///
/// @param sets     "PATH=VALUE" lines of the command line; they count as if they stood in the file
/// @param convert  reads files of other programs that it names; null: they are refused
/// @throws ModelError  with every problem of the file
Model read_model(const std::filesystem::path& path, const std::vector<std::string>& sets = {},
                 ConvertFile convert = nullptr);

/// Checks that a model has an operating speed.
/// @throws ModelError  if it has none
void require_speed(const Model& model);

/// Reads a model from a text: for tests, and for models stored in results, which have their tables
/// in them.
/// @param name   for messages
/// @param files  files that the model may name; left out: none, which is right for any text that a
///               stranger may have written
Model parse_model(const std::string& text, const std::string& name = "model",
                  const std::vector<std::string>& sets = {}, const NamedFiles& files = {});

}  // namespace whirl::inline io
