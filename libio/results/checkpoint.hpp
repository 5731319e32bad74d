#pragma once
/// What a study of many points has found so far, and how it gets into a file and back.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "libio/results/hdf5.hpp"

namespace whirl {

/// Attribute of a dataset of codes: words separated by commas, the first one of code 0.
inline constexpr const char* words_attribute = "words";

/// A dataset of a study: one number of every point, or several.
struct PointColumn {
  std::string name;  ///< below the group of the study
  std::string units, long_name;
  bool is_integer = false;
  std::vector<Eigen::Index> shape{};  ///< of what a point has; empty: one number
  std::vector<std::string> axes{};    ///< paths of the datasets along it
  std::string words{};                ///< of codes, as words_attribute; empty: none
  bool may_lack = false;              ///< in files that were begun without it: it stays NaN or -1

  std::size_t size() const;
};

/// One vector per column.
using PointRow = std::vector<std::vector<double>>;

/// The points of a study, each computed or not yet.
///
/// Its datasets have the shape of the study, then that of the column. Points that are not computed
/// are NaN, or -1 in columns of integers; `done` tells them apart, and is left out once all are.
class PointTable {
 public:
  /// @param group  of the result file, such as "/map"
  /// @param shape  how many points there are along each axis
  /// @param axes   paths of the datasets along these, written before this
  PointTable(std::string group, std::vector<PointColumn> columns, std::vector<Eigen::Index> shape,
             std::vector<std::string> axes);

  std::size_t points() const { return done_.size(); }
  bool is_done(std::size_t point) const { return done_[point] != 0; }
  std::size_t done() const;

  /// Numbers of a column at a point.
  std::span<const double> at(const std::string& column, std::size_t point) const;
  double number(const std::string& column, std::size_t point) const { return at(column, point)[0]; }

  /// Enters a computed point; what is missing in a row stays NaN or -1, what is too long is cut.
  void put(std::size_t point, const PointRow& row);

  void write(ResultWriter& file) const;
  /// Takes over what a file holds.
  /// @throws FileError  if it is not of this shape
  void read(const ResultReader& file);

 private:
  std::size_t index_of(const std::string& column) const;

  std::string group_;
  std::vector<PointColumn> columns_;
  std::vector<Eigen::Index> shape_;
  std::vector<std::string> axes_;
  std::vector<std::vector<double>> values_;  ///< per column, points x size
  std::vector<int> done_;
};

}  // namespace whirl
