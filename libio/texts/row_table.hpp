#pragma once
/// Tables for people of lists of rows: what a column is called, its unit and its numbers come from
/// the columns() of the row (libbase/structs/column.hpp).
///
///   table_of(found.criticals, {row_number("number"), shown("speed", "rpm", ".2f"), shown("whirl"),
///                              {"excitation", [](const Critical& c) { return c.excitation(); }}})
///
/// What is not known (NaN, an optional without value, an empty text) is "-".

#include <concepts>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libio/results/cells.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

/// A column of a row, and how a table shows it.
struct Shown {
  std::string_view key;     ///< of the column
  std::string_view unit;    ///< that numbers are shown in, "rpm", "um", "%"; empty: the column's
  std::string_view format;  ///< of numbers, as fmt has it, ".2f"; empty: with an engineer's prefix
  std::string heading;      ///< before the unit

  /// The column with another heading than its key; the unit still stands behind the heading.
  Shown as(std::string_view other) const;
};
Shown shown(std::string_view key, std::string_view unit = "", std::string_view format = "");

/// Numbers of the rows, from 1.
struct RowNumber {
  std::string heading;
};
inline RowNumber row_number(std::string heading) {
  return {std::move(heading)};
}

namespace texts {

/// How a column's numbers become texts.
struct NumberStyle {
  std::string unit;      ///< that is shown in the heading; empty: none
  double divisor = 1.0;  ///< SI units in one shown unit
  std::string format;    ///< ".2f"; empty: with an engineer's prefix
  std::string si_unit;   ///< of the column
};
/// @throws std::logic_error  if the unit does not measure what the column holds
NumberStyle style_of(const Shown& shown, std::string_view si_unit);
std::string heading_of(const Shown& shown, const NumberStyle& style);

/// A number by a format, zero without a sign unless the format has one; "-" for NaN.
std::string number_text(double value, std::string_view format);
std::string number_text(double value, const NumberStyle& style);

template <class T>
constexpr bool is_shown = columns::Text<T> || std::is_enum_v<T> || std::is_arithmetic_v<T>;
template <columns::Maybe T>
constexpr bool is_shown<T> = is_shown<typename T::value_type>;

/// A value of a column.
/// @param offset  of whole numbers: 1 where they are shown from one
template <class T>
std::string value_text(const T& value, const NumberStyle& style, int offset = 0) {
  if constexpr (columns::Maybe<T>) {
    return value ? value_text(*value, style, offset) : "-";
  } else if constexpr (columns::Text<T>) {
    const std::string_view text = value;
    return text.empty() ? "-" : std::string(text);
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(name_of(value));
  } else if constexpr (std::same_as<T, bool>) {
    return value ? "yes" : "no";
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value + offset);
  } else {
    return number_text(value, style);
  }
}

}  // namespace texts

/// A column of a table of rows: a column of their type, the numbers of the rows, or a text of its
/// own.
template <class Row>
struct TableColumn {
  std::string heading;
  std::function<std::string(const Row&, int number)> cell;

  /// @throws std::logic_error  if the row has no such column, or a column of lists
  TableColumn(const Shown& wanted) requires HasColumns<Row> {
    for_each_column<Row>([&](const auto& c) {
      if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
        if constexpr (texts::is_shown<ColumnValue<Row, decltype(c.member)>>) {
          if (cell || c.key != wanted.key) return;
          const texts::NumberStyle style = texts::style_of(wanted, c.unit);
          heading = texts::heading_of(wanted, style);
          cell = [member = c.member, style, offset = c.is_from_one ? 1 : 0](const Row& row, int) {
            return texts::value_text(std::invoke(member, row), style, offset);
          };
        }
      }
    });
    if (!cell) throw std::logic_error("no column to show: " + std::string(wanted.key));
  }

  TableColumn(RowNumber number)
      : heading(std::move(number.heading)),
        cell([](const Row&, int row) { return std::to_string(row); }) {}

  /// @param f  gives the text of a row, or of a row and its number from 1
  template <class F>
  requires std::invocable<F, const Row&> || std::invocable<F, const Row&, int> TableColumn(
      std::string title, F f)
      : heading(std::move(title)) {
    if constexpr (std::invocable<F, const Row&, int>) {
      cell = std::move(f);
    } else {
      cell = [f = std::move(f)](const Row& row, int) { return f(row); };
    }
  }
};

template <class Row>
using TableColumns = std::vector<TableColumn<Row>>;

/// Columns without the one of frequencies in Hz where those in rpm are shown in the same unit.
/// @param in_hertz  number of that column, from 0
template <class Row>
TableColumns<Row> in_both_units(TableColumns<Row> columns, std::size_t in_hertz) {
  if (shown_unit("rpm").name == shown_unit("Hz").name) {
    columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(in_hertz));
  }
  return columns;
}

/// The table of a list of rows.
template <class Rows>
std::string table_of(const Rows& rows, const TableColumns<typename Rows::value_type>& columns) {
  std::vector<std::string> head;
  for (const auto& column : columns) head.push_back(column.heading);
  Table table(std::move(head));
  int number = 0;
  for (const auto& row : rows) {
    ++number;
    std::vector<std::string> cells;
    for (const auto& column : columns) cells.push_back(column.cell(row, number));
    table.row(std::move(cells));
  }
  return table.text();
}

}  // namespace whirl::inline io
