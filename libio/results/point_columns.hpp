#pragma once
/// Points of a study by their columns (libbase/structs/column.hpp): a row as numbers of datasets,
/// and back.

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_codes.hpp"

namespace whirl::inline io::study_columns {

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

/// Writes a value as the numbers of one point: numbers that have no place are cut, places without a
/// number stay as they are.
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

/// What describes a dataset of points, whatever its type. Its dimensions are those behind the
/// points; an axis has its own dimension.
struct Facts : columns::Facts {
  bool is_integer = false;
  std::string words{};  ///< of codes, as words_attribute; empty: none
};

/// A dataset of points, and how numbers get from a row into it and back.
template <class Row>
struct PointColumn {
  Facts facts{};
  std::function<void(const Row&, std::span<double>)> put{};
  /// @param rows  size of the dataset's first dimension
  std::function<void(Row&, std::span<const double>, std::size_t rows)> take{};
  bool is_of_motion = false;  ///< its numbers are not known where the motion failed
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
using RowOf = typename decltype(Result::points)::value_type;

}  // namespace whirl::inline io::study_columns
