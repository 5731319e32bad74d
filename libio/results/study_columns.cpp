#include "libio/results/study_columns.hpp"

#include <fmt/format.h>

#include <sstream>

namespace whirl::inline io::study_columns {

namespace {

std::size_t product(std::span<const Eigen::Index> sizes) {
  std::size_t all = 1;
  for (const Eigen::Index n : sizes) all *= static_cast<std::size_t>(n);
  return all;
}

}  // namespace

Facts done_column() {
  return {{.name = "done",
           .unit = "",
           .meaning = "whether a point is computed",
           .dimensions = "",
           .values = valid::from_to(0.0, 1.0),
           .is_optional = true},
          true};
}

StudyWriter::StudyWriter(ResultWriter& file, std::string_view group, const ColumnSizes& sizes)
    : file_(file), group_(group) {
  for (const auto& [name, size] : sizes) axes_[std::string(name)] = {"", size};
}

void StudyWriter::add_axis(const std::string& dimension, const std::string& path,
                           Eigen::Index size) {
  axes_[dimension] = {path, size};
}

std::string StudyWriter::axis(const std::string& dimension) const {
  const auto found = axes_.find(dimension);
  return found == axes_.end() ? "" : found->second.path;
}

void StudyWriter::write_parameters(const std::vector<ParameterAxis>& parameters,
                                   const std::string& leads) {
  if (const auto leading = axes_.find(leads); leading != axes_.end()) {
    points_.push_back(leading->second);
  }
  for (const ParameterAxis& p : parameters) {
    const std::string place = path(fmt::format("axis_{}", &p - parameters.data() + 1));
    file_.dataset(place, p.values, {p.unit, p.path, {""}});
    points_.push_back({place, std::ssize(p.values)});
  }
}

std::size_t StudyWriter::width(const Facts& column) const {
  std::size_t numbers = 1;
  for (const std::string& name : dimension_names(column.dimensions)) {
    const auto axis = axes_.find(name);
    numbers *= axis == axes_.end() ? 0 : static_cast<std::size_t>(axis->second.size);
  }
  return numbers;
}

DatasetBlocks StudyWriter::begin_points(const Facts& column) {
  std::vector<Eigen::Index> shape;
  DatasetInfo info{column.unit, column.meaning, {}};
  const auto add = [&](const Axis& axis) {
    shape.push_back(axis.size);
    info.axes.push_back(axis.path);
  };
  for (const Axis& axis : points_) add(axis);
  for (const std::string& name : dimension_names(column.dimensions)) {
    const auto axis = axes_.find(name);
    add(axis == axes_.end() ? Axis{} : axis->second);
  }
  const std::string place = path(column.name);
  DatasetBlocks dataset = file_.dataset_blocks(
      place, column.is_integer ? ObjectKind::integer : ObjectKind::real, shape, info);
  if (!column.words.empty()) file_.attribute(place, words_attribute, column.words);
  return dataset;
}

void StudyWriter::write_points(const Facts& column, std::span<const double> values) {
  DatasetBlocks dataset = begin_points(column);
  dataset.add(values);
  dataset.finish();
}

void StudyWriter::write_done(std::size_t points, const std::function<bool(std::size_t)>& is_done) {
  std::vector<double> done(points);
  for (std::size_t i = 0; i < points; ++i) done[i] = is_done(i) ? 1.0 : 0.0;
  const bool is_complete = std::count(done.begin(), done.end(), 0.0) == 0;
  file_.attribute(group_, "complete", is_complete ? 1 : 0);
  if (!is_complete) write_points(done_column(), done);
}

namespace {

std::vector<std::string> split_words(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream from(list);
  for (std::string word; std::getline(from, word, ',');) words.push_back(word);
  return words;
}

/// Per code of a list of words that of the same word in another list; -1 for words that this one is
/// without.
std::vector<double> translation(const std::string& from, const std::string& to) {
  const std::vector<std::string> ours = split_words(to);
  std::vector<double> codes;
  for (const std::string& word : split_words(from)) {
    const auto found = std::find(ours.begin(), ours.end(), word);
    codes.push_back(found == ours.end() ? -1.0 : static_cast<double>(found - ours.begin()));
  }
  return codes;
}

}  // namespace

std::size_t stored_points(const ResultReader& file, const std::string& group) {
  const std::string path = group + "/motion";
  if (!file.has(path)) return 0;
  const std::vector<Eigen::Index> shape = file.shape(path);
  return static_cast<std::size_t>(product(shape));
}

std::optional<StoredColumn> stored_column(const ResultReader& file, const std::string& group,
                                          const Facts& column, std::size_t points,
                                          Missing missing) {
  const std::string path = group + '/' + column.name;
  const bool may_miss = column.is_optional || missing == Missing::allowed;
  if (may_miss && !file.has(path)) return std::nullopt;
  const std::vector<Eigen::Index> shape = file.shape(path);
  const std::size_t behind = dimension_names(column.dimensions).size();
  const std::span<const Eigen::Index> all(shape);
  const bool fits = shape.size() >= behind && product(all.first(shape.size() - behind)) == points;
  if (!fits) {
    throw FileError(fmt::format("{} is not of {} points: it is of another study", path, points));
  }
  StoredColumn stored{.file = file, .path = path, .width = product(all.last(behind))};
  if (behind > 0) stored.rows = static_cast<std::size_t>(shape[shape.size() - behind]);
  if (!column.words.empty() && file.has_attribute(path, words_attribute)) {
    const std::string words = file.string_attribute(path, words_attribute);
    if (words != column.words) stored.codes = translation(words, column.words);
  }
  return stored;
}

std::vector<double> StoredColumn::numbers(std::size_t first, std::size_t points) const {
  std::vector<double> values = file.numbers(path, first * width, points * width);
  if (!codes) return values;
  for (double& code : values) {
    const bool is_known = code >= 0.0 && code < static_cast<double>(codes->size());
    code = is_known ? (*codes)[static_cast<std::size_t>(code)] : -1.0;
  }
  return values;
}

std::vector<bool> read_done(const ResultReader& file, const std::string& group,
                            std::size_t points) {
  const bool says = file.has_attribute(group, "complete");
  if (says && file.number_attribute(group, "complete") != 0.0) {
    return std::vector<bool>(points, true);
  }
  const auto flags = stored_column(file, group, done_column(), points);
  std::vector<bool> done;
  if (!flags) return std::vector<bool>(points, !says);
  file.each_block(flags->path, [&](std::span<const double> values) {
    for (const double flag : values) done.push_back(flag != 0.0);
  });
  return done;
}

ResultEntry entry_of(const std::string& group, const Facts& column) {
  Facts of_points = column;
  of_points.dimensions = column.dimensions.empty() ? "point" : "point " + column.dimensions;
  return columns::entry_of(group + '/' + column.name, of_points,
                           column.is_integer ? ObjectKind::integer : ObjectKind::real);
}

}  // namespace whirl::inline io::study_columns

namespace whirl::inline io {

StoredParameter stored_parameter(const ResultReader& file, const std::string& path) {
  return {file.string_attribute(path, "long_name"), file.string_attribute(path, "units"),
          file.numbers(path)};
}

std::vector<StoredParameter> stored_parameters(const ResultReader& file, std::string_view group) {
  std::vector<StoredParameter> all;
  for (int number = 1;; ++number) {
    const std::string path = fmt::format("{}/axis_{}", group, number);
    if (!file.has(path)) return all;
    all.push_back(stored_parameter(file, path));
  }
}

}  // namespace whirl::inline io
