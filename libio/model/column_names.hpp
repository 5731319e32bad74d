#pragma once
/// Names that people and other programs give the columns of tables: one list for all of whirl.

#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// What a name stands for.
struct ColumnName {
  std::string column;     ///< whirl's name of it: "outer_diameter"
  std::string_view unit;  ///< that the name itself says, as "rpm" does; empty: none
};

/// What a name may stand for, the likeliest first: "n" is a speed, or the number of a station.
/// @param name  capitals, accents, blanks, "_", "-" and "." in it do not count
const std::vector<ColumnName>& columns_called(std::string_view name);

/// Whether a name is that of a column of remarks, which nobody reads.
bool names_remarks(std::string_view name);

}  // namespace whirl::inline io
