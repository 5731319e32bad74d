#include "libio/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace whirl {

std::size_t PointColumn::size() const {
  std::size_t product = 1;
  for (const Eigen::Index n : shape) product *= static_cast<std::size_t>(n);
  return product;
}

PointTable::PointTable(std::string group, std::vector<PointColumn> columns,
                       std::vector<Eigen::Index> shape, std::vector<std::string> axes)
    : group_(std::move(group)),
      columns_(std::move(columns)),
      shape_(std::move(shape)),
      axes_(std::move(axes)) {
  assert(axes_.size() == shape_.size());
  std::size_t points = 1;
  for (const Eigen::Index n : shape_) points *= static_cast<std::size_t>(n);
  done_.assign(points, 0);
  for (const PointColumn& c : columns_) {
    values_.emplace_back(points * c.size(),
                         c.is_integer ? -1.0 : std::numeric_limits<double>::quiet_NaN());
  }
}

std::size_t PointTable::done() const {
  return static_cast<std::size_t>(std::count(done_.begin(), done_.end(), 1));
}

std::size_t PointTable::index_of(const std::string& column) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const PointColumn& c) { return c.name == column; });
  assert(found != columns_.end());
  return static_cast<std::size_t>(found - columns_.begin());
}

std::span<const double> PointTable::at(const std::string& column, std::size_t point) const {
  const std::size_t i = index_of(column), size = columns_[i].size();
  return {values_[i].data() + point * size, size};
}

void PointTable::put(std::size_t point, const PointRow& row) {
  for (std::size_t i = 0; i < std::min(row.size(), columns_.size()); ++i) {
    const std::size_t size = columns_[i].size(), given = std::min(size, row[i].size());
    std::copy_n(row[i].begin(), given,
                values_[i].begin() + static_cast<std::ptrdiff_t>(point * size));
  }
  done_[point] = 1;
}

void PointTable::write(ResultWriter& file) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const PointColumn& c = columns_[i];
    std::vector<Eigen::Index> shape = shape_;
    shape.insert(shape.end(), c.shape.begin(), c.shape.end());
    DatasetInfo info{c.units, c.long_name, axes_};
    info.axes.insert(info.axes.end(), c.axes.begin(), c.axes.end());
    info.axes.resize(shape.size());
    const std::string path = group_ + '/' + c.name;
    if (c.is_integer) {
      const std::vector<int> whole(values_[i].begin(), values_[i].end());
      file.dataset(path, whole, shape, info);
    } else {
      file.dataset(path, values_[i], shape, info);
    }
    if (!c.words.empty()) file.attribute(path, words_attribute, c.words);
  }
  const bool is_complete = done() == points();
  file.attribute(group_, "complete", is_complete ? 1 : 0);
  if (!is_complete) {
    file.dataset(group_ + "/done", done_, shape_, {"", "whether a point is computed", axes_});
  }
}

void PointTable::read(const ResultReader& file) {
  const auto take = [&](const std::string& path, std::size_t size) {
    std::vector<double> values = file.numbers(path);
    if (values.size() != size) {
      throw FileError(fmt::format("{} has {} values, expected {}: it is of another study", path,
                                  values.size(), size));
    }
    return values;
  };
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string path = group_ + '/' + columns_[i].name;
    const bool lacks = columns_[i].may_lack && !file.has(path);
    values.push_back(lacks ? values_[i] : take(path, values_[i].size()));
  }
  std::vector<int> done(points(), 1);
  if (file.number_attribute(group_, "complete") == 0.0) {
    const std::vector<double> flags = take(group_ + "/done", points());
    done.assign(flags.begin(), flags.end());
  }
  values_ = std::move(values);
  done_ = std::move(done);
}

}  // namespace whirl
