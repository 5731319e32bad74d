#pragma once
/// Reading a whole model file.

#include <vector>

#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// Builds a model from the tree of a file, collecting all problems.
class ModelBuilder {
 public:
  /// @param asked  receives every key that is asked for; null: not wanted
  ModelBuilder(const ConfigNode& root, NamedFiles files, std::vector<AskedKey>* asked = nullptr);

  /// @throws ModelError  with every problem found
  Model build();
  /// The model again, without reading the rotor again: since `base` only tables that are not of the
  /// rotor may have been changed in the tree, no contact or oil film may have moved, and no film
  /// may have another spring.
  ///
  /// @throws ModelError  likewise
  Model rebuild(const Model& base);

  /// The tables that build() read from files of their own.
  const std::vector<FileTable>& file_tables() const { return reading_.file_tables; }
  /// What in these tables is right and seldom meant.
  const std::vector<Problem>& doubts() const { return reading_.doubts; }

 private:
  ModelReading reading_;
};

}  // namespace whirl::inline io
