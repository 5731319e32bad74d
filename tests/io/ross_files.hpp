#pragma once
// Files of ROSS, read as models.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/import/parse_json.hpp"
#include "libio/import/ross_model.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::test {

inline ImportedModel imported(const std::string& text, const std::string& name = "rotor.toml") {
  const ConfigNode root = name.ends_with(".json") ? parse_json(text, name) : parse_toml(text, name);
  return model_of(read_ross(root), name, "rotor");
}

/// The model as it is read from its files.
inline Model model_in_files(const ImportedModel& written) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("whirl_ross_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rotor.toml") << written.text;
  for (const ImportedTable& table : written.tables) {
    std::ofstream(folder / table.name) << table.text;
  }
  Model model = read_model(folder / "rotor.toml");
  std::filesystem::remove_all(folder);
  return model;
}

/// What is wrong with a file, or "nothing".
inline std::string refusal(const std::string& text, const std::string& name = "rotor.toml") {
  try {
    imported(text, name);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "nothing";
}

inline bool has_part(const std::vector<std::string>& sentences, const std::string& part) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return sentence.find(part) != std::string::npos;
  });
}

}  // namespace whirl::test
