#pragma once
/// Tables of a printed report.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libio/drawing/figure.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

/// A table with its caption, and what is to be said below it.
struct Sheet {
  std::string caption;
  FigureTable table;
  std::vector<std::string> notes{};
};

/// A number without unit to five digits, zero without a sign.
inline std::string five_digits(double value) {
  return fmt::format("{:.5g}", value == 0.0 ? 0.0 : value);
}
/// A speed [rad/s] in the shown unit of rpm, without its name; "-" for NaN.
inline std::string rpm_text(double speed) {
  return shown_number(speed, "rpm", ".1f");
}
/// The same with the unit: "3600.0 rpm".
inline std::string speed_text(double speed) {
  return shown_value(speed, "rpm", ".1f");
}
/// A share: "12.3 %"; "-" where it is not finite.
inline std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : std::string("-");
}

/// A list of rows as a table, by the columns of row_table.hpp.
template <class Rows>
FigureTable sheet_table(const Rows& rows, const TableColumns<typename Rows::value_type>& columns) {
  FigureTable table;
  for (const auto& column : columns) table.header.push_back(column.heading);
  int number = 0;
  for (const auto& row : rows) {
    ++number;
    std::vector<std::string> cells;
    for (const auto& column : columns) cells.push_back(column.cell(row, number));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// Takes columns out of a table whose cells are all the same, and says them in a note instead.
/// @param first  number of the first column that may go
inline void tell_common(Sheet& sheet, std::size_t first) {
  FigureTable& t = sheet.table;
  if (t.rows.size() < 3) return;
  std::string common;
  for (std::size_t c = t.header.size(); c-- > first;) {
    const std::string& value = t.rows.front()[c];
    const bool is_same =
        std::all_of(t.rows.begin(), t.rows.end(), [&](const auto& row) { return row[c] == value; });
    if (!is_same) continue;
    common = fmt::format("{}: {}{}", t.header[c], value, common.empty() ? "" : "; " + common);
    const auto at = static_cast<std::ptrdiff_t>(c);
    t.header.erase(t.header.begin() + at);
    for (auto& row : t.rows) row.erase(row.begin() + at);
  }
  if (!common.empty()) sheet.notes.push_back("In all rows: " + common + ".");
}

}  // namespace whirl::inline io
