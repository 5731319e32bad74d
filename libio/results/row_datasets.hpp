#pragma once
/// Datasets that say one thing each of every row of a list.

#include <numeric>
#include <string>
#include <vector>

#include "libbase/constants.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

/// Writes datasets of rows. The axes of what it is given are those behind that of the rows.
template <class Row>
class RowDatasets {
 public:
  /// @param axis  path of the dataset along the rows, which is to be written first
  RowDatasets(ResultWriter& file, std::vector<Row> rows, std::string axis)
      : file_(file), rows_(std::move(rows)), axis_(std::move(axis)) {}

  const std::vector<Row>& rows() const { return rows_; }

  /// The dataset along the rows: their numbers from 1, or a number of each.
  void numbers(const std::string& meaning) const {
    std::vector<int> all(rows_.size());
    std::iota(all.begin(), all.end(), 1);
    file_.dataset(axis_, all, {"", meaning, {""}});
  }
  template <class F>
  void axis(DatasetInfo info, const F& number) const {
    info.axes = {""};
    file_.dataset(axis_, column(number), info);
  }

  /// A number or text of each row.
  template <class F>
  void one(const std::string& path, const DatasetInfo& info, const F& value) const {
    file_.dataset(path, column(value), with_rows(info));
  }
  /// Numbers of each row, as many as the shape says.
  template <class F>
  void many(const std::string& path, const DatasetInfo& info, std::vector<Eigen::Index> shape,
            const F& values) const {
    std::vector<double> all;
    for (const Row& r : rows_) {
      const auto& of_row = values(r);
      all.insert(all.end(), of_row.begin(), of_row.end());
    }
    shape.insert(shape.begin(), std::ssize(rows_));
    file_.dataset(path, all, shape, with_rows(info));
  }
  /// A complex number of each row.
  template <class F>
  void complex(const std::string& path, const DatasetInfo& info, const F& value) const {
    CVec all(std::ssize(rows_));
    for (Eigen::Index i = 0; i < all.size(); ++i)
      all(i) = value(rows_[static_cast<std::size_t>(i)]);
    file_.dataset(path, all, with_rows(info));
  }
  /// So many complex numbers of each row; NaN where it has fewer.
  template <class F>
  void complex(const std::string& path, const DatasetInfo& info, Eigen::Index size,
               const F& values) const {
    CMat all = CMat::Constant(std::ssize(rows_), size, Complex(nan, nan));
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      const CVec& of_row = values(rows_[static_cast<std::size_t>(i)]);
      const Eigen::Index known = std::min(size, of_row.size());
      all.row(i).head(known) = of_row.head(known).transpose();
    }
    file_.dataset(path, all, with_rows(info));
  }

 private:
  template <class F>
  auto column(const F& value) const {
    std::vector<std::decay_t<decltype(value(rows_.front()))>> all;
    for (const Row& r : rows_) all.push_back(value(r));
    return all;
  }
  DatasetInfo with_rows(DatasetInfo info) const {
    info.axes.insert(info.axes.begin(), axis_);
    return info;
  }

  ResultWriter& file_;
  std::vector<Row> rows_;
  std::string axis_;
};

}  // namespace whirl::inline io
