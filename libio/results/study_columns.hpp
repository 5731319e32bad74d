#pragma once
/// Studies of many points: into a result file and back, and as what a file is checked against.
///
/// A dataset has the shape of the study, then that of its column. Points that are not computed are
/// NaN, or -1 in columns of integers; `done` says which points are computed, and is left out once
/// all are.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "libdyn/studies/row_travel.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libio/results/coarse_grid.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/point_columns.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

namespace study_columns {

/// The column that says which points are computed.
Facts done_column();

using columns::dimension_names;

/// Writes the group of a study; knows the datasets along its dimensions.
class StudyWriter {
 public:
  StudyWriter(ResultWriter& file, std::string_view group, const ColumnSizes& sizes);

  std::string path(std::string_view key) const { return group_ + '/' + std::string(key); }
  /// Notes a dataset along a dimension, which has been written before.
  void add_axis(const std::string& dimension, const std::string& path, Eigen::Index size);
  /// The dataset along a dimension; empty: none is known.
  std::string axis(const std::string& dimension) const;
  /// Writes the parameters of the points, whose dimensions come behind `leads`, if that is a known
  /// dimension.
  void write_parameters(const std::vector<ParameterAxis>& parameters, const std::string& leads);
  /// Numbers that a column has of a point.
  std::size_t width(const Facts& column) const;
  /// @throws WritingGivenUp
  void go_on() const { file_.go_on(); }
  /// Begins the dataset of a column; its numbers come point after point.
  DatasetBlocks begin_points(const Facts& column);
  /// @param values  of all points
  void write_points(const Facts& column, std::span<const double> values);
  /// @param is_done  whether a point is computed
  void write_done(std::size_t points, const std::function<bool(std::size_t)>& is_done);

 private:
  struct Axis {
    std::string path;  ///< empty: none
    Eigen::Index size = 0;
  };
  ResultWriter& file_;
  std::string group_;
  std::map<std::string, Axis, std::less<>> axes_;
  std::vector<Axis> points_;  ///< along the points
};

/// Whether a column of a whole study is along a dimension of its own, not a number of every point.
template <class Member>
constexpr bool is_aside(const Column<Member>& c) {
  return c.is_axis || !(c.dimensions.empty() || c.dimensions == "point");
}

/// Whether columns may be missing that are not optional, as in files of earlier versions.
enum class Missing { refused, allowed };

/// A column of a study's points in a file.
struct StoredColumn {
  const ResultReader& file;
  std::string path;
  std::size_t width = 1;  ///< numbers of a point
  std::size_t rows = 1;   ///< size of its first dimension
  /// For every code of the file the code that the same word has here, -1 for unknown words; none:
  /// the codes are the same.
  std::optional<std::vector<double>> codes{};

  /// The numbers of some points, one after the other.
  std::vector<double> numbers(std::size_t first, std::size_t points) const;
};
/// The column in a file; nothing if it is missing and may be.
/// @throws FileError  if the column is not of so many points
std::optional<StoredColumn> stored_column(const ResultReader& file, const std::string& group,
                                          const Facts& column, std::size_t points,
                                          Missing missing = Missing::refused);
/// How many points a file has; 0: none of this study.
std::size_t stored_points(const ResultReader& file, const std::string& group);
/// Which points a file has.
std::vector<bool> read_done(const ResultReader& file, const std::string& group, std::size_t points);

/// The entry of a column of points, which files are checked against.
ResultEntry entry_of(const std::string& group, const Facts& column);

}  // namespace study_columns

/// A parameter of a study, as a file has it.
struct StoredParameter {
  std::string path, unit;
  std::vector<double> values;  ///< [SI]
};

/// Numbers of rows that are in memory together while a file is written or read.
constexpr std::size_t numbers_at_once = std::size_t{1} << 21;

/// Writes the rows of a study, block by block.
template <class Result>
void write_rows(study_columns::StudyWriter& to, const Result& result, std::size_t most_numbers) {
  using namespace study_columns;
  using Row = study_columns::RowOf<Result>;
  std::vector<PointColumn<Row>> columns;
  std::vector<DatasetBlocks> datasets;
  std::size_t of_point = 0;
  for (PointColumn<Row>& column : point_columns<Row>()) {
    if constexpr (requires { result.leaves_out(""); }) {
      if (result.leaves_out(column.facts.name)) continue;
    }
    datasets.push_back(to.begin_points(column.facts));
    of_point += to.width(column.facts);
    columns.push_back(std::move(column));
  }
  const std::size_t at_once = std::max<std::size_t>(1, most_numbers / of_point);
  for (std::size_t first = 0; first < result.points.size(); first += at_once) {
    to.go_on();
    std::vector<std::optional<Row>> rows;
    const std::size_t last = std::min(first + at_once, result.points.size());
    for (std::size_t i = first; i < last; ++i) rows.push_back(result.points[i]);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t width = to.width(columns[c].facts);
      std::vector<double> values(width * rows.size(),
                                 columns[c].facts.is_integer ? -1.0 : std::nan(""));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i] || (columns[c].is_of_motion && motion_of(*rows[i]).has_failed())) continue;
        columns[c].put(*rows[i], {values.data() + i * width, width});
      }
      datasets[c].add(values);
    }
  }
  for (DatasetBlocks& dataset : datasets) dataset.finish();
}

/// Writes what a study has found so far as its group of a result file.
/// @param parameters  those of its points, in the order of its grid
/// @throws FileError  as ResultWriter
template <class Result>
void write_study(ResultWriter& file, const std::vector<ParameterAxis>& parameters,
                 const Result& result, std::size_t most_numbers = numbers_at_once) {
  using namespace study_columns;
  StudyWriter to(file, Result::group, result.sizes());
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      const auto& values = std::invoke(c.member, result);
      if (!is_aside(c) || (c.is_optional && values.size() == 0)) return;
      const std::string dimension = dimension_names(c.dimensions)[0];
      file.dataset(
          to.path(c.key), values,
          {std::string(c.unit), std::string(c.meaning), {c.is_axis ? "" : to.axis(dimension)}});
      if (!c.is_axis) return;
      to.add_axis(dimension, to.path(c.key), static_cast<Eigen::Index>(values.size()));
    }
  });
  std::string leads;
  if constexpr (requires { Result::leads; }) leads = Result::leads;
  to.write_parameters(parameters, leads);
  write_rows(to, result, most_numbers);
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      const auto& values = std::invoke(c.member, result);
      using Element = typename std::remove_cvref_t<decltype(values)>::value_type;
      if constexpr (std::is_arithmetic_v<Element>) {
        if (is_aside(c) || values.size() == 0) return;
        to.write_points(facts_of<Element>(c), std::vector<double>(values.begin(), values.end()));
      }
    }
  });
  to.write_done(result.points.size(), [&](std::size_t i) { return result.points.has(i); });
}

/// How rows are read.
struct RowReading {
  study_columns::Missing missing = study_columns::Missing::refused;
  std::function<bool(std::size_t)> is_wanted{};  ///< whether a point is wanted; empty: all are
  std::size_t most_numbers = numbers_at_once;    ///< in memory
};

/// Calls f with the number and the row of every point that a file has of a study, in their order.
/// @param points  how many points the study has
/// @throws FileError  as ResultReader, and if the file has another number of points
template <class Result, class F>
void each_stored_row(const ResultReader& file, std::size_t points, const F& f,
                     const RowReading& reading = {}) {
  using namespace study_columns;
  using Row = study_columns::RowOf<Result>;
  const std::string group(Result::group);
  const std::vector<bool> done = read_done(file, group, points);
  std::vector<PointColumn<Row>> columns;
  std::vector<StoredColumn> stored;
  std::size_t of_point = 1;
  for (PointColumn<Row>& column : point_columns<Row>()) {
    auto here = stored_column(file, group, column.facts, points, reading.missing);
    if (!here) continue;
    of_point += here->width;
    stored.push_back(std::move(*here));
    columns.push_back(std::move(column));
  }
  const std::size_t at_once = std::max<std::size_t>(1, reading.most_numbers / of_point);
  for (std::size_t first = 0; first < points; first += at_once) {
    std::vector<std::pair<std::size_t, Row>> rows;  // by their numbers within the block
    const std::size_t count = std::min(at_once, points - first);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_wanted = !reading.is_wanted || reading.is_wanted(first + i);
      if (done[first + i] && is_wanted) rows.push_back({i, Row{}});
    }
    if (rows.empty()) continue;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t width = stored[c].width;
      const std::vector<double> values = stored[c].numbers(first, count);
      for (auto& [i, row] : rows) {
        columns[c].take(row, {values.data() + i * width, width}, stored[c].rows);
      }
    }
    for (auto& [i, row] : rows) {
      if (motion_of(row).has_failed()) motion_of(row) = {};
      f(first + i, std::move(row));
    }
  }
}

/// Reads the points of a study, to go on from.
/// @return  a result with these points and nothing else
/// @throws FileError  as each_stored_row
template <class Result>
Result read_study(const ResultReader& file, std::size_t points) {
  Result result;
  result.points.resize(points);
  each_stored_row<Result>(file, points,
                          [&](std::size_t i, const auto& row) { result.points.set(i, row); });
  return result;
}

/// What a file holds of a study, to be shown: its points, or some of them, and the members that
/// describe the points. Columns that a file of an earlier version lacks are as in a new row.
/// @throws FileError  as ResultReader
template <class Result>
Result stored_study(const ResultReader& file, const CoarseGrid& grid = {}) {
  using namespace study_columns;
  const std::string group(Result::group);
  const std::size_t points = stored_points(file, group);
  Result result;
  result.points.resize(grid.is_all() ? points : grid.points());
  RowReading reading{.missing = Missing::allowed};
  if (!grid.is_all()) reading.is_wanted = [&](std::size_t i) { return grid.has(i); };
  each_stored_row<Result>(
      file, points,
      [&](std::size_t i, const auto& row) {
        result.points.set(grid.is_all() ? i : grid.number_of(i), row);
      },
      reading);
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Member = std::remove_cvref_t<decltype(c.member)>;
      if constexpr (columns::is_read<Result, Member>) {
        const auto kind = columns::kind_of<ColumnValue<Result, Member>>();
        auto cells = columns::read_cells(file, group + '/' + std::string(c.key), kind);
        if (!cells) return;
        Eigen::Index count = 1;
        for (const Eigen::Index n : cells->shape) count *= n;
        auto& values = std::invoke(c.member, result);
        columns::Taking(*cells).take(values, std::span(&count, 1));
        if (c.dimensions != "point" || grid.is_all()) return;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (grid.has(i)) values[kept++] = values[i];
        }
        values.resize(kept);
      }
    }
  });
  return result;
}

/// Path of a dataset of a study's points.
/// @param key  of a column of its rows
template <class Result>
std::string point_dataset(std::string_view key) {
  for (const auto& column : study_columns::point_columns<study_columns::RowOf<Result>>()) {
    if (column.facts.name == key) return std::string(Result::group) + '/' + std::string(key);
  }
  return {};
}

/// The parameter whose values are a dataset.
StoredParameter stored_parameter(const ResultReader& file, const std::string& path);
/// The parameters of a study's points.
std::vector<StoredParameter> stored_parameters(const ResultReader& file, std::string_view group);

/// The entries that a file with a study is checked against.
/// @param parameters  entries of its parameters
template <class Result>
ResultSet study_schema(const std::vector<ResultEntry>& parameters) {
  using namespace study_columns;
  const std::string group(Result::group);
  std::vector<ResultEntry> entries;
  for (const auto& column : point_columns<study_columns::RowOf<Result>>()) {
    entries.push_back(entry_of(group, column.facts));
  }
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Element = typename ColumnValue<Result, decltype(c.member)>::value_type;
      ResultEntry entry = entry_of(group, facts_of<Element>(c));
      if constexpr (std::is_convertible_v<Element, std::string>) entry.kind = ObjectKind::text;
      if (is_aside(c)) entry.sizes = c.dimensions;
      entries.push_back(entry);
    }
  });
  entries.insert(entries.end(), parameters.begin(), parameters.end());
  entries.push_back(entry_of(group, done_column()));
  return {std::move(entries)};
}

}  // namespace whirl::inline io
