#pragma once
/// The datasets and attributes of a result for numpy: of one in memory, or of a file, each read
/// when it is asked for.

#include <pybind11/numpy.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "libio/results/hdf5.hpp"

namespace whirl::inline python {

class Store {
 public:
  explicit Store(std::shared_ptr<KeptResult> kept) : kept_(std::move(kept)) {}
  /// @throws FileError  as open_result
  explicit Store(const std::string& file);

  /// Paths of all datasets, in the order of their writing, of a file in that of the alphabet.
  std::vector<std::string> paths() const;
  /// (unit, meaning, paths of axes, shape, names of the dimensions) of a dataset.
  pybind11::tuple info(const std::string& path) const;
  /// Numbers as a read-only array, which looks at this result's memory and keeps it alive; texts as
  /// a list.
  pybind11::object values(const std::string& path);
  /// (object, name, value) of all.
  pybind11::list attributes() const;
  /// Writes all of it as a result file.
  /// @throws FileError  as ResultWriter
  void save(const std::string& file, bool replaces_anything);

 private:
  KeptResult::Dataset& dataset(const std::string& path) const;
  void load(KeptResult::Dataset& dataset);

  std::shared_ptr<KeptResult> kept_;
  std::unique_ptr<ResultReader> reader_{};  ///< null: all is in memory
  std::set<std::string> loaded_{};          ///< of what is read when it is asked for
};

}  // namespace whirl::inline python
