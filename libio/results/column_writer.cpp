#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "libio/results/columns.hpp"

namespace whirl::inline io::columns {

namespace {

/// Writes a group of a result file; knows the datasets along its dimensions.
class GroupWriter {
 public:
  /// @param parameter_of  says what the parameter of a dataset is; may be empty
  GroupWriter(ResultWriter& file, std::string_view group, ParameterOf parameter_of)
      : file_(file), group_(group), parameter_of_(std::move(parameter_of)) {}

  void attribute(const std::string& name, const Cells& cells);
  void dataset(const Facts& facts, Cells cells);
  void dataset(const Facts& facts, const Mat& values);
  /// Size of a dimension that a dataset written before stands along; 0: none does.
  Eigen::Index size_of(std::string_view dimension) const;

 private:
  struct Axis {
    std::string path;
    Eigen::Index size = 0;
  };
  /// What stands beside a dataset of a shape, whose axis is known from now on if it is one.
  DatasetInfo info_of(const Facts& facts, std::span<const Eigen::Index> shape);

  ResultWriter& file_;
  std::string group_;
  ParameterOf parameter_of_;
  std::map<std::string, Axis, std::less<>> axes_;
};

void GroupWriter::attribute(const std::string& name, const Cells& cells) {
  switch (cells.kind) {
    case ObjectKind::text:
      return file_.attribute(group_, name, cells.texts.at(0));
    case ObjectKind::integer:
      return file_.attribute(group_, name, cells.integers.at(0));
    default:
      return file_.attribute(group_, name, cells.reals.at(0));
  }
}

DatasetInfo GroupWriter::info_of(const Facts& facts, std::span<const Eigen::Index> shape) {
  const std::vector<std::string> names = dimension_names(facts.dimensions);
  DatasetInfo info{facts.unit, facts.meaning, {}};
  if (facts.unit == unit_of_parameter && parameter_of_) {
    const ParameterName name = parameter_of_(facts.name);
    info.units = name.unit;
    info.long_name = name.path;
  }
  for (const std::string& name : names) {
    const auto axis = axes_.find(name);
    const bool has_axis = !facts.is_axis && axis != axes_.end();
    info.axes.push_back(name.starts_with('/') ? name : has_axis ? axis->second.path : "");
  }
  info.axes.resize(shape.size());
  if (facts.is_axis) {
    axes_.insert_or_assign(names.at(0), Axis{group_ + "/" + facts.name, shape[0]});
  }
  return info;
}

void GroupWriter::dataset(const Facts& facts, const Mat& values) {
  const Eigen::Index shape[] = {values.rows(), values.cols()};
  file_.dataset(group_ + "/" + facts.name, values, info_of(facts, shape));
}

void GroupWriter::dataset(const Facts& facts, Cells cells) {
  const std::string path = group_ + "/" + facts.name;
  const DatasetInfo info = info_of(facts, cells.shape);
  switch (cells.kind) {
    case ObjectKind::text:
      return file_.dataset(path, cells.texts, info);
    case ObjectKind::integer:
      return file_.dataset(path, cells.integers, cells.shape, info);
    case ObjectKind::complex:
      if (cells.shape.size() == 1) {
        return file_.dataset(path, CVec(CVec::Map(cells.complexes.data(), cells.shape[0])), info);
      }
      return file_.dataset(
          path, CMat(CMat::Map(cells.complexes.data(), cells.shape[1], cells.shape[0]).transpose()),
          info);
    default:
      return file_.dataset(path, cells.reals, cells.shape, info);
  }
}

Eigen::Index GroupWriter::size_of(std::string_view dimension) const {
  Eigen::Index fixed = 0;
  for (const char c : dimension) {
    if (c < '0' || c > '9') {
      const auto axis = axes_.find(dimension);
      return axis == axes_.end() ? 0 : axis->second.size;
    }
    fixed = 10 * fixed + (c - '0');
  }
  return fixed;
}

std::size_t product(const std::vector<Eigen::Index>& extents) {
  std::size_t all = 1;
  for (const Eigen::Index n : extents) all *= static_cast<std::size_t>(n);
  return all;
}

/// Fills a row that knows nothing with NaN, so that those behind it stand at their places.
/// @param size  of all cells so far, that of this row included
void fill_row(Cells& cells, std::size_t size, std::string_view column) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (cells.kind == ObjectKind::real && cells.reals.size() < size) {
    cells.reals.resize(size, unknown);
  } else if (cells.kind == ObjectKind::complex && cells.complexes.size() < size) {
    cells.complexes.resize(size, {unknown, unknown});
  } else if (cells.size() != size) {
    throw std::logic_error("rows of different sizes in column " + std::string(column));
  }
}

/// Writes a column of a list of rows.
void write_in_rows(GroupWriter& group, const AnyColumn& list, const void* rows, std::size_t count,
                   const AnyColumn& c) {
  if (!c.is_in_rows()) return;
  Cells cells{.kind = c.kind, .shape = {static_cast<Eigen::Index>(count)}};
  const AnyColumn::ToValue add = [&](const void* value) { c.put(cells, value, c.offset()); };
  std::vector<Eigen::Index> extents;  // of the largest row: others may know nothing
  const AnyColumn::ToValue find_extents = [&](const void* value) {
    const auto found = c.extents(value);
    if (extents.empty() || product(found) > product(extents))
      extents.assign(found.begin(), found.end());
  };
  for (std::size_t i = 0; i < count && c.rank > 0; ++i) {
    c.give(row_at(rows, list.row_size, i), find_extents);
  }
  if (c.rank > 0 && count == 0) {
    for (const std::string& d : dimension_names(c.info.dimensions)) {
      extents.push_back(group.size_of(d));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    c.give(row_at(rows, list.row_size, i), add);
    if (c.rank > 0) fill_row(cells, (i + 1) * product(extents), c.info.key);
  }
  cells.shape.insert(cells.shape.end(), extents.begin(), extents.end());
  if (c.info.is_optional && cells.is_empty()) return;
  group.dataset(facts_of(c.info, list.rows.dimension, list.rows.prefix), std::move(cells));
}

void write_rows(GroupWriter& group, const AnyColumn& list, const void* rows, std::size_t count) {
  if (list.rows.is_optional && count == 0) return;
  if (!list.rows.number.empty()) {
    Cells numbers{.kind = ObjectKind::integer, .shape = {static_cast<Eigen::Index>(count)}};
    for (std::size_t i = 1; i <= count; ++i) numbers.integers.push_back(static_cast<int>(i));
    group.dataset(number_facts(list.rows), std::move(numbers));
  }
  for (const AnyColumn& c : list.of_row) write_in_rows(group, list, rows, count, c);
}

void write_value(GroupWriter& group, const AnyColumn& c, const void* value) {
  if (c.info.is_optional && c.is_maybe && c.is_empty(value)) return;
  if (c.is_matrix) {  // may be large: not copied
    const Mat& matrix = *static_cast<const Mat*>(value);
    if (!c.info.is_optional || matrix.size() > 0) group.dataset(facts_of(c.info), matrix);
    return;
  }
  Cells cells{.kind = c.kind};
  if (c.extents) cells.shape = c.extents(value);
  c.put(cells, value, c.offset());
  if (c.info.is_optional && cells.is_empty()) return;
  if (c.rank == 0) {
    group.attribute(std::string(c.info.key), cells);
  } else {
    group.dataset(facts_of(c.info), std::move(cells));
  }
}

}  // namespace

void write_group(ResultWriter& file, std::string_view group, Columns columns, const void* result,
                 const ParameterOf& parameter_of) {
  GroupWriter to(file, group, parameter_of);
  for (const AnyColumn& c : columns) {
    if (c.is_rows) {
      if (c.rows.written == Written::in_json) continue;
      c.give_rows(result,
                  [&](const void* rows, std::size_t count) { write_rows(to, c, rows, count); });
    } else if (c.is_in_files()) {
      c.give(result, [&](const void* value) { write_value(to, c, value); });
    }
  }
}

}  // namespace whirl::inline io::columns
