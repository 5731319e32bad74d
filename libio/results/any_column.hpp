#pragma once
/// Columns of results (libbase/structs/column.hpp) whatever their types: lists that the compiler
/// makes, so that the code that reads, writes and tells results is compiled once, and not for every
/// result.

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libio/results/cells.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io::columns {

/// A column of a result, or of one of its rows; a function that is not needed is null.
struct AnyColumn {
  using ToValue = std::function<void(const void* value)>;
  using ToRows = std::function<void(const void* rows, std::size_t count)>;
  using Shape = std::span<const Eigen::Index>;

  ColumnInfo info{};
  ObjectKind kind = ObjectKind::other;  ///< of its elements, in a file
  int rank = 0;                         ///< dimensions of a value
  bool fits_files = false;
  bool is_maybe = false;   ///< a std::optional
  bool is_matrix = false;  ///< a Mat, which may be large
  void (*give)(const void* owner, const ToValue& to) = nullptr;
  void* (*member)(void* owner) = nullptr;  ///< of columns that are read back
  std::vector<Eigen::Index> (*extents)(const void* value) = nullptr;
  void (*put)(Cells& cells, const void* value, int offset) = nullptr;
  void (*take)(Taking& from, void* value, Shape shape, int offset) = nullptr;
  bool (*is_empty)(const void* value) = nullptr;  ///< a text, list or optional
  Record (*record)(const void* value, double divisor, int offset) = nullptr;

  /// For a list of rows in place of a value.
  RowsInfo rows{};
  bool is_rows = false;
  std::span<const AnyColumn> of_row{};
  std::size_t row_size = 0;  ///< [bytes]
  void (*give_rows)(const void* owner, const ToRows& to) = nullptr;
  void* (*resize)(void* owner, std::size_t count) = nullptr;  ///< gives the rows

  int offset() const { return info.is_from_one ? 1 : 0; }
  bool is_in_files() const { return put != nullptr; }
  /// Whether the column is a dataset as a column of rows.
  bool is_in_rows() const { return is_in_files() && fits_files; }
  /// The first dataset of a list of rows, which must have one.
  const AnyColumn& first_of_row() const {
    return *std::find_if(of_row.begin(), of_row.end(), std::mem_fn(&AnyColumn::is_in_rows));
  }
};

/// A row of a list.
inline const void* row_at(const void* rows, std::size_t row_size, std::size_t i) {
  return static_cast<const char*>(rows) + row_size * i;
}
inline void* row_at(void* rows, std::size_t row_size, std::size_t i) {
  return static_cast<char*>(rows) + row_size * i;
}

/// Whether a column is a member of a result, or of a part of one, and not computed from it.
template <class T, class Member>
constexpr bool is_read =
    std::is_same_v<std::invoke_result_t<const Member&, T&>, ColumnValue<T, Member>&>;

template <class T>
Record record_value(const T& value, double divisor, int offset = 0);

template <class Value>
bool is_empty_value(const void* value) {
  const auto& v = *static_cast<const Value*>(value);
  if constexpr (Maybe<Value>) {
    return !v.has_value();
  } else {
    return is_empty(v);
  }
}

template <class Value>
void put_value(Cells& cells, const void* value, int offset) {
  const auto& v = *static_cast<const Value*>(value);
  if constexpr (Maybe<Value>) {
    put(cells, *v, offset);
  } else {
    put(cells, v, offset);
  }
}

template <class Value>
void take_value(Taking& from, void* value, std::span<const Eigen::Index> shape, int offset) {
  auto& v = *static_cast<Value*>(value);
  if constexpr (Maybe<Value>) {
    from.take(v.emplace(), {}, offset);
  } else {
    from.take(v, shape, offset);
  }
}

template <class Value>
std::vector<Eigen::Index> extents_of_value(const void* value) {
  return extents_of(*static_cast<const Value*>(value));
}

template <class Value>
Record record_of_value(const void* value, double divisor, int offset) {
  return record_value(*static_cast<const Value*>(value), divisor, offset);
}

template <HasColumns T, std::size_t I>
constexpr AnyColumn any_column();

template <HasColumns T, std::size_t... I>
constexpr auto make_any_columns(std::index_sequence<I...>) {
  return std::array<AnyColumn, sizeof...(I)>{any_column<T, I>()...};
}

/// All columns of a struct.
template <HasColumns T>
inline constexpr auto any_columns =
    make_any_columns<T>(std::make_index_sequence<decltype(T::columns())::size>());

/// What a column gives of its owner.
template <HasColumns T, std::size_t I, class Owner>
decltype(auto) of_owner(Owner* owner) {
  using Struct = std::conditional_t<std::is_const_v<Owner>, const T, T>;
  return std::invoke(lists::at<I>(columns_of<T>).member, *static_cast<Struct*>(owner));
}

template <HasColumns T, std::size_t I>
constexpr AnyColumn any_rows() {
  constexpr const auto& c = lists::at<I>(columns_of<T>);
  using Member = std::remove_cvref_t<decltype(c.member)>;
  using Row = RowOf<T, Member>;
  AnyColumn any;
  any.rows = c;
  any.is_rows = true;
  // points of studies are read and written by point_columns.hpp
  if constexpr (HasColumns<Row> && std::ranges::contiguous_range<ColumnValue<T, Member>>) {
    any.of_row = any_columns<Row>;
    any.row_size = sizeof(Row);
    any.give_rows = [](const void* owner, const AnyColumn::ToRows& to) {
      const auto& list = of_owner<T, I>(owner);
      to(std::data(list), std::size(list));
    };
    if constexpr (is_read<T, Member>) {
      any.resize = [](void* owner, std::size_t count) -> void* {
        auto& list = of_owner<T, I>(owner);
        list.resize(count);
        return std::data(list);
      };
    }
  }
  return any;
}

template <HasColumns T, std::size_t I>
constexpr AnyColumn any_column() {
  constexpr const auto& c = lists::at<I>(columns_of<T>);
  if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
    return any_rows<T, I>();
  } else {
    using Member = std::remove_cvref_t<decltype(c.member)>;
    using Value = ColumnValue<T, Member>;
    AnyColumn any;
    any.info = c;
    any.kind = kind_of<Value>();
    any.rank = rank_of<Value>();
    any.fits_files = fits_files<Value>;
    any.is_maybe = Maybe<Value>;
    any.is_matrix = std::is_same_v<Value, Mat>;
    any.give = [](const void* owner, const AnyColumn::ToValue& to) {
      const auto& value = of_owner<T, I>(owner);
      to(&value);
    };
    any.is_empty = &is_empty_value<Value>;
    if constexpr (c.written != Written::in_file) any.record = &record_of_value<Value>;
    constexpr bool is_told = fits_files<Value> || (fits_attributes<Value> && c.is_optional);
    if constexpr (c.written != Written::in_json && is_told) {
      any.put = &put_value<Value>;
      if constexpr (fits_files<Value>) any.extents = &extents_of_value<Value>;
      if constexpr (is_read<T, Member>) {
        any.member = [](void* owner) -> void* { return &of_owner<T, I>(owner); };
        any.take = &take_value<Value>;
      }
    }
    return any;
  }
}

}  // namespace whirl::inline io::columns
