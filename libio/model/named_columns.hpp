#pragma once
/// The line of a table that names its columns.

#include <string>
#include <vector>

#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

/// A column that is there: what it is, and the unit of its cells.
struct NamedColumn {
  const ColumnKind* kind = nullptr;  ///< null: nobody reads it
  std::string unit{};                ///< empty: SI, or as written beside each number
  int place = 1;                     ///< of its name in the line
  bool needs_unit = false;           ///< and has none yet
};

/// The delimiter of a line of names. Blanks stand in names, too: they delimit where nothing else
/// does and two names or more are known that way.
Delimiter delimiter_of_names(const std::string& line, const std::vector<ColumnKind>& kinds);

/// The columns that a line names, in its order.
/// @param doubt  receives columns that are not known; null: not wanted
std::vector<NamedColumn> named_columns(const std::string& line, Delimiter delimiter,
                                       const std::vector<ColumnKind>& kinds,
                                       const ReportProblem& report, const ReportProblem& doubt);

/// Takes the units of a line that has nothing else; whether it is one.
bool take_units(std::vector<NamedColumn>& columns, const std::vector<Cell>& cells,
                const ReportProblem& report);

}  // namespace whirl::inline io
