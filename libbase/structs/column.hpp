#pragma once
/// Columns: one table per result says what it holds, in which units, and what it means. Result
/// files, JSON, checks of files that are read, and the manual all work from these tables, as model
/// files do from fields (field.hpp).

#include <concepts>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace whirl::inline base {

/// Values that numbers of a dataset or attribute can have.
struct ValidValues {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool has_gaps = true;          ///< NaN stands where nothing is known
  std::string_view counts = {};  ///< a dimension whose elements these numbers count, from 1
};

namespace valid {
constexpr double largest = std::numeric_limits<double>::max();
constexpr ValidValues any{};
constexpr ValidValues finite{-largest, largest, false};
constexpr ValidValues nonnegative{0.0, largest, false};
constexpr ValidValues positive{std::numeric_limits<double>::denorm_min(), largest, false};

constexpr ValidValues from_to(double least, double most) {
  return {least, most, false};
}
/// Numbers of the elements of a dimension, from 1.
constexpr ValidValues numbers_of(std::string_view dimension) {
  return {1.0, largest, false, dimension};
}
}  // namespace valid

/// Where a column is written.
enum class Written { everywhere, in_file, in_json };

/// What a column says of a member, whatever its type.
struct ColumnInfo {
  std::string_view key;      ///< dataset or attribute, below the group
  std::string_view unit;     ///< SI unit; empty if it has none
  std::string_view meaning;  ///< what it is, for a plot's axis and the manual
  /// Dimensions by name, beyond the dimension of the rows: "stations speeds". Dimensions of one
  /// name have one size throughout a file. A number stands for a size, a path for the dataset along
  /// the dimension; "+" behind a name: at least one element.
  std::string_view dimensions = "";
  ValidValues values{};
  /// Key in JSON; empty: the key with its unit, "speed_rpm" for rad/s, "x_m". Frequencies are in
  /// rpm in JSON if their key there ends in "_rpm".
  std::string_view json_key = "";
  Written written = Written::everywhere;
  bool is_axis = false;      ///< numbers or names along its one dimension, for other datasets
  bool is_from_one = false;  ///< a number from 0 that is written from 1
  bool is_optional = false;  ///< see Column::maybe()
};

/// One member of a result.
///
/// A member of a whole result that is one number, text or choice is an attribute of its group; one
/// that has many numbers is a dataset. A member of a row is a dataset of all rows together.
template <class Member>
struct Column : ColumnInfo {
  /// Pointer to a member, or function of the result. What a function gives is read back from files
  /// only if it is a reference to a part of the result.
  Member member;

  constexpr Column along(std::string_view names) const { return with(&Column::dimensions, names); }
  /// @param name  of the column's dimension; left out for a member of a row: the dimension of the
  ///              rows
  constexpr Column axis(std::string_view name = "") const {
    return along(name).with(&Column::is_axis, true);
  }
  constexpr Column within(const ValidValues& range) const { return with(&Column::values, range); }
  constexpr Column as(std::string_view name) const { return with(&Column::json_key, name); }
  constexpr Column only(Written place) const { return with(&Column::written, place); }
  constexpr Column from_one() const { return with(&Column::is_from_one, true); }
  /// The column is left out of files if it is empty, and files without it are whole; a column of
  /// JSON only is left out of JSON.
  constexpr Column maybe() const { return with(&Column::is_optional, true); }

 private:
  template <class Value>
  constexpr Column with(Value ColumnInfo::*fact, const Value& value) const {
    Column c = *this;
    c.*fact = value;
    return c;
  }
};

template <class Member>
constexpr Column<Member> column(std::string_view key, Member member, std::string_view unit,
                                std::string_view meaning) {
  return {{key, unit, meaning}, member};
}

/// What a column of rows says, whatever their type.
struct RowsInfo {
  std::string_view dimension;     ///< of the rows: "branches"; their key in JSON, too
  std::string_view number = "";   ///< dataset of their numbers, 1, 2, ...; empty: none
  std::string_view meaning = "";  ///< of the numbers
  std::string_view prefix = "";   ///< of their datasets: "critical_"
  bool is_optional = false;       ///< see RowsColumn::maybe()
  Written written = Written::everywhere;
};

/// A member of a result that is a list of structs with columns of their own.
template <class Member>
struct RowsColumn : RowsInfo {
  Member member;  ///< pointer to a member, or function of the result

  constexpr RowsColumn numbered(std::string_view name, std::string_view what) const {
    return with(&RowsColumn::number, name).with(&RowsColumn::meaning, what);
  }
  constexpr RowsColumn prefixed(std::string_view text) const {
    return with(&RowsColumn::prefix, text);
  }
  constexpr RowsColumn only(Written place) const { return with(&RowsColumn::written, place); }
  /// As Column::maybe(): an empty list has no datasets.
  constexpr RowsColumn maybe() const { return with(&RowsColumn::is_optional, true); }

 private:
  template <class Value>
  constexpr RowsColumn with(Value RowsInfo::*fact, const Value& value) const {
    RowsColumn c = *this;
    c.*fact = value;
    return c;
  }
};

template <class Member>
constexpr RowsColumn<Member> rows(Member member, std::string_view dimension) {
  return {{dimension}, member};
}

namespace lists {
template <std::size_t Number, class C>
struct Place {
  C column;
};
template <class Numbers, class... C>
struct Places;
template <std::size_t... Number, class... C>
struct Places<std::index_sequence<Number...>, C...> : Place<Number, C>... {};
}  // namespace lists

/// The columns of a struct, in their order: ColumnList{column(...), rows(...)}. A std::tuple of as
/// many takes compilers several times as long.
template <class... C>
struct ColumnList : lists::Places<std::index_sequence_for<C...>, C...> {
  static constexpr std::size_t size = sizeof...(C);
};
template <class... C>
ColumnList(C...) -> ColumnList<C...>;

namespace lists {
template <std::size_t Number, class C>
constexpr const C& at(const Place<Number, C>& place) {
  return place.column;
}
template <class... A, class... B, std::size_t... I, std::size_t... J>
constexpr ColumnList<A..., B...> join(const ColumnList<A...>& a, const ColumnList<B...>& b,
                                      std::index_sequence<I...>, std::index_sequence<J...>) {
  return {at<I>(a)..., at<J>(b)...};
}
template <class... C, std::size_t... I, class F>
constexpr void for_each(const ColumnList<C...>& list, std::index_sequence<I...>, const F& f) {
  (f(at<I>(list)), ...);
}
}  // namespace lists

/// Lists one behind the other.
template <class... A>
constexpr ColumnList<A...> joined(const ColumnList<A...>& list) {
  return list;
}
template <class... A, class... B, class... Lists>
constexpr auto joined(const ColumnList<A...>& a, const ColumnList<B...>& b, const Lists&... lists) {
  return joined(lists::join(a, b, std::index_sequence_for<A...>(), std::index_sequence_for<B...>()),
                lists...);
}

/// A struct that names its members: `static constexpr auto columns()`, a list of them.
template <class T>
concept HasColumns = requires {
  T::columns();
};

/// A struct with columns that is a group of a result file:
/// `static constexpr std::string_view group`, too.
template <class T>
concept HasGroup = HasColumns<T> && requires {
  { T::group } -> std::convertible_to<std::string_view>;
};

template <class T>
constexpr bool is_rows_column = false;
template <class Member>
constexpr bool is_rows_column<RowsColumn<Member>> = true;

/// The columns of a struct, made by the compiler.
template <HasColumns T>
inline constexpr auto columns_of = T::columns();

/// Calls f with every column of a struct.
template <HasColumns T, class F>
constexpr void for_each_column(const F& f) {
  constexpr std::size_t size = decltype(T::columns())::size;
  lists::for_each(columns_of<T>, std::make_index_sequence<size>(), f);
}

/// Type of what a column gives of a struct.
template <class T, class Member>
using ColumnValue = std::remove_cvref_t<std::invoke_result_t<Member, const T&>>;

/// Type of the rows of a column of rows.
template <class T, class Member>
using RowOf = typename ColumnValue<T, Member>::value_type;

}  // namespace whirl::inline base
