#pragma once
/// Points of a study by their columns (libbase/column.hpp): into a result file and back, and as what a
/// file is checked against.
///
/// A dataset has the shape of the study, then that of its column. Points that are not computed are NaN,
/// or -1 in columns of integers; `done` tells them apart, and is left out once all are.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "libbase/column.hpp"
#include "libbase/field.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/motion_codes.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

namespace study_columns {

template <class T>
struct CodeOf {
  static constexpr bool is = std::is_enum_v<T>;
  using type = T;
};
template <class T>
struct CodeOf<std::optional<T>> {
  static constexpr bool is = std::is_enum_v<T>;
  using type = T;
};

template <class T>
constexpr bool is_scalar = std::is_arithmetic_v<T> || CodeOf<T>::is;
template <class T>
constexpr bool is_integer = std::is_integral_v<T> || CodeOf<T>::is;

/// Numbers of one point; what a value has more is cut, what it lacks stays as it is.
template <class T>
void put(const T& value, std::span<double> to) {
  if constexpr (requires { value.has_value(); }) {
    if (value) put(*value, to);
  } else if constexpr (is_scalar<T>) {
    to[0] = static_cast<double>(value);
  } else if constexpr (requires { T::ColsAtCompileTime; }) {
    std::size_t at = 0;
    for (Eigen::Index i = 0; i < value.rows(); ++i) {
      for (Eigen::Index j = 0; j < value.cols() && at < to.size(); ++j) to[at++] = value(i, j);
    }
  } else {
    std::copy_n(value.begin(), std::min(value.size(), to.size()), to.begin());
  }
}

/// @param rows  of a matrix
template <class T>
void take(T& value, std::span<const double> from, std::size_t rows) {
  if constexpr (requires { value.has_value(); }) {
    if (from[0] >= 0.0) value = static_cast<typename T::value_type>(static_cast<int>(from[0]));
  } else if constexpr (CodeOf<T>::is) {
    value = static_cast<T>(static_cast<int>(from[0]));
  } else if constexpr (std::is_same_v<T, bool>) {
    value = from[0] > 0.0;
  } else if constexpr (is_scalar<T>) {
    value = static_cast<T>(from[0]);
  } else if constexpr (requires { T::ColsAtCompileTime; }) {
    const std::size_t cols = T::ColsAtCompileTime == 1 ? 1 : from.size() / std::max(rows, 1ul);
    value.resize(static_cast<Eigen::Index>(cols == 0 ? 0 : from.size() / cols),
                 static_cast<Eigen::Index>(cols));
    for (std::size_t i = 0; i < from.size(); ++i) {
      value(static_cast<Eigen::Index>(i / cols), static_cast<Eigen::Index>(i % cols)) = from[i];
    }
  } else {
    value.assign(from.begin(), from.end());
  }
}

/// What a dataset of points is described by, whatever its type; its dimensions are those behind the
/// points, of an axis its own.
struct Facts : columns::Facts {
  bool is_integer = false;
  std::string words{};  ///< of codes, as words_attribute; empty: none
};

/// The column that says which points are computed.
Facts done_column();

/// A dataset of points, and how numbers get from a row into it and back.
template <class Row>
struct PointColumn {
  Facts facts{};
  std::function<void(const Row&, std::span<double>)> put{};
  /// @param rows  size of its first dimension
  std::function<void(Row&, std::span<const double>, std::size_t rows)> take{};
  bool is_of_motion = false;  ///< not known where the motion failed
};

/// Words of codes, and what they mean for people.
template <class T>
void add_words(Facts& facts) {
  using Code = typename CodeOf<T>::type;
  facts.words = code_words<Code>();
  facts.meaning += ": " + code_legend<Code>() + (std::is_enum_v<T> ? "" : ", -1 failed");
  facts.values = {-1.0, static_cast<double>(choices(Code{}).size() - 1), false};
}

template <class Value, class Member>
Facts facts_of(const Column<Member>& c, std::string_view before = "") {
  Facts facts{columns::facts_of(c, before), is_integer<Value>};
  if (c.dimensions == "point") facts.dimensions = before;
  if constexpr (std::is_same_v<Value, bool>) facts.values = {-1.0, 1.0, false};
  if constexpr (CodeOf<Value>::is) add_words<Value>(facts);
  return facts;
}

/// Adds the columns of a part of a row.
/// @param part  gives the part of a row, whose members can be set if the row can
template <class Row, HasColumns Part, class Get>
void add_columns(std::vector<PointColumn<Row>>& to, const Get& part) {
  for_each_column<Part>([&](const auto& c) {
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Element = RowOf<Part, decltype(c.member)>;
      for_each_column<Element>([&](const auto& inner) {
        using Value = ColumnValue<Element, decltype(inner.member)>;
        to.push_back({facts_of<Value>(inner, c.dimension),
                      [=](const Row& row, std::span<double> all) {
                        const auto& list = std::invoke(c.member, part(row));
                        for (std::size_t i = 0; i < list.size(); ++i) {
                          study_columns::put(std::invoke(inner.member, list[i]), all.subspan(i, 1));
                        }
                      },
                      [=](Row& row, std::span<const double> all, std::size_t) {
                        auto& list = std::invoke(c.member, part(row));
                        list.resize(all.size());
                        for (std::size_t i = 0; i < list.size(); ++i) {
                          study_columns::take(std::invoke(inner.member, list[i]), all.subspan(i, 1),
                                              1);
                        }
                      }});
      });
    } else {
      using Value = ColumnValue<Part, decltype(c.member)>;
      to.push_back({facts_of<Value>(c),
                    [=](const Row& row, std::span<double> all) {
                      study_columns::put(std::invoke(c.member, part(row)), all);
                    },
                    [=](Row& row, std::span<const double> all, std::size_t rows) {
                      study_columns::take(std::invoke(c.member, part(row)), all, rows);
                    }});
    }
  });
}

/// All columns of a row: those of its motion first.
template <class Row>
std::vector<PointColumn<Row>> point_columns() {
  std::vector<PointColumn<Row>> all;
  add_columns<Row, ClassifiedMotion>(
      all, [](auto& row) -> auto& { return motion_of(row); });
  for (PointColumn<Row>& c : all) c.is_of_motion = true;
  if constexpr (!std::is_same_v<Row, ClassifiedMotion>) {
    add_columns<Row, Row>(
        all, [](auto& row) -> auto& { return row; });
  }
  return all;
}

template <class Result>
using RowOf = typename decltype(Result::points)::value_type::value_type;

using columns::dimension_names;

/// Writes the group of a study; knows the datasets along its dimensions.
class StudyWriter {
 public:
  StudyWriter(ResultWriter& file, std::string_view group, const ColumnSizes& sizes);

  std::string path(std::string_view key) const { return group_ + '/' + std::string(key); }
  /// Enters a dataset along a dimension; it has been written.
  void add_axis(const std::string& dimension, const std::string& path, Eigen::Index size);
  /// The dataset along a dimension; empty: none is known.
  std::string axis(const std::string& dimension) const;
  /// Writes the parameters of the points, behind the dimension that leads, if there is one.
  void write_parameters(const std::vector<ParameterAxis>& parameters, const std::string& leads);
  /// Numbers that a column has of a point.
  std::size_t width(const Facts& column) const;
  /// @param values  of all points, one after the other
  void write_points(const Facts& column, const std::vector<double>& values);
  void write_done(const std::vector<int>& done);

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

/// Numbers of a column of so many points as a file has them, and the size of its first dimension;
/// nothing if it may be missing and is. Codes are those of the words that stand beside them, whatever
/// their order there; -1 for words that are unknown.
struct StoredColumn {
  std::vector<double> values;
  std::size_t rows = 1;
};
std::optional<StoredColumn> read_column(const ResultReader& file, const std::string& group,
                                        const Facts& column, std::size_t points,
                                        Missing missing = Missing::refused);
/// How many points a file has; 0: none of this study.
std::size_t stored_points(const ResultReader& file, const std::string& group);
/// Which points a file has.
std::vector<bool> read_done(const ResultReader& file, const std::string& group, std::size_t points);

/// What a file is checked against that has a column of points.
ResultEntry entry_of(const std::string& group, const Facts& column);

}  // namespace study_columns

/// A parameter of a study, as a file has it.
struct StoredParameter {
  std::string path, unit;
  std::vector<double> values;  ///< [SI]
};

/// Writes what a study has found so far as its group of a result file.
/// @param parameters  those of its points, in the order of its grid
/// @throws FileError  as ResultWriter
template <class Result>
void write_study(ResultWriter& file, const std::vector<ParameterAxis>& parameters,
                 const Result& result) {
  using namespace study_columns;
  using Row = study_columns::RowOf<Result>;
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
  for (const PointColumn<Row>& column : point_columns<Row>()) {
    if constexpr (requires { result.leaves_out(""); }) {
      if (result.leaves_out(column.facts.name)) continue;
    }
    const std::size_t width = to.width(column.facts);
    std::vector<double> values(width * result.points.size(),
                               column.facts.is_integer ? -1.0 : std::nan(""));
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      const auto& row = result.points[i];
      if (!row || (column.is_of_motion && motion_of(*row).has_failed())) continue;
      column.put(*row, {values.data() + i * width, width});
    }
    to.write_points(column.facts, values);
  }
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      const auto& values = std::invoke(c.member, result);
      using Element = typename std::remove_cvref_t<decltype(values)>::value_type;
      if constexpr (std::is_arithmetic_v<Element>) {
        if (is_aside(c) || values.size() == 0) return;
        to.write_points(facts_of<Element>(c), {values.begin(), values.end()});
      }
    }
  });
  std::vector<int> done;
  for (const auto& row : result.points) done.push_back(row ? 1 : 0);
  to.write_done(done);
}

/// Reads the points of a study, to go on from.
/// @param points  how many it has
/// @return  a result that knows nothing else
/// @throws FileError  as ResultReader, and if it has another number of points
template <class Result>
Result read_study(const ResultReader& file, std::size_t points,
                  study_columns::Missing missing = study_columns::Missing::refused) {
  using namespace study_columns;
  using Row = study_columns::RowOf<Result>;
  const std::string group(Result::group);
  const std::vector<bool> done = read_done(file, group, points);
  Result result;
  result.points.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    if (done[i]) result.points[i].emplace();
  }
  for (const PointColumn<Row>& column : point_columns<Row>()) {
    const auto stored = read_column(file, group, column.facts, points, missing);
    if (!stored || points == 0) continue;
    const std::size_t width = stored->values.size() / points;
    for (std::size_t i = 0; i < points; ++i) {
      if (!done[i]) continue;
      column.take(*result.points[i], {stored->values.data() + i * width, width}, stored->rows);
    }
  }
  for (auto& row : result.points) {
    if (row && motion_of(*row).has_failed()) motion_of(*row) = {};
  }
  return result;
}

/// All that a file holds of a study, to be shown: its points, and the members that say what they are
/// of. What a file of an earlier version is without is as in a new row.
/// @throws FileError  as ResultReader
template <class Result>
Result stored_study(const ResultReader& file) {
  using namespace study_columns;
  const std::string group(Result::group);
  auto result = read_study<Result>(file, stored_points(file, group), Missing::allowed);
  for_each_column<Result>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Given = std::invoke_result_t<decltype(c.member), Result&>;
      if constexpr (std::is_same_v<Given, std::remove_cvref_t<Given>&>) {
        const auto kind = columns::kind_of<std::remove_cvref_t<Given>>();
        auto cells = columns::read_cells(file, group + '/' + std::string(c.key), kind);
        if (!cells) return;
        Eigen::Index count = 1;
        for (const Eigen::Index n : cells->shape) count *= n;
        columns::Taking(*cells).take(std::invoke(c.member, result), std::span(&count, 1));
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

/// What a file is checked against that holds a study.
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
