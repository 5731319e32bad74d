#pragma once
/// The bow of a shaft, as it is measured: run-out against position.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline io {

/// Reads a bow from CSV.
///
/// The first line that is not a comment (#) names the columns, in any order, each with its unit in
/// brackets (without one, SI): position; x and y, of which one may be left out, or deflection and
/// angle (from +x to +y; left out: 0). Positions ascend; two are needed.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with file and line
/// @param doubts    receives columns that are not read; null: not wanted
Bow parse_bow_table(const std::string& text, const std::string& file,
                    std::vector<Problem>& problems, std::vector<Problem>* doubts = nullptr);

/// How many columns of such a table a line names.
std::size_t bow_columns_named_in(const std::string& line);

}  // namespace whirl::inline io
