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
/// @param plain  a name as plain_name gives it
const std::vector<ColumnName>& columns_called(std::string_view plain);

/// Whether a name, as plain_name gives it, is that of a column of remarks, which nobody reads.
bool names_remarks(std::string_view plain);

}  // namespace whirl::inline io
