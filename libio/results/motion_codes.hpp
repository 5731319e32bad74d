#pragma once
/// Kinds of motion in result files: numbers, with the words they stand for beside them.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/studies/classify.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl {

/// Words of all kinds of motion, by their codes: "equilibrium,periodic,...".
std::string motion_words();

/// The same for people: "0 equilibrium, 1 periodic, ..., -1 failed".
std::string motion_legend();

/// What the codes of a dataset mean: by its words, else, as in files without them, by their order.
class MotionCodes {
 public:
  /// @throws FileError  as ResultReader
  MotionCodes(const ResultReader& file, const std::string& dataset);

  /// Nothing for a motion that failed, or whose word is unknown.
  std::optional<MotionKind> kind(double code) const;

 private:
  std::vector<std::optional<MotionKind>> kinds_;
};

}  // namespace whirl
