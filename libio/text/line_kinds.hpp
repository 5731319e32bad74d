#pragma once
/// What a line of a table of text is: a row of numbers, or what people write above and below.

#include <string>
#include <string_view>
#include <vector>

#include "libio/text/delimited.hpp"

namespace whirl::inline io {

/// Where the numeral of a cell ends, behind which its unit is.
std::size_t numeral_end(std::string_view cell);

/// Whether a line is one of numbers: half of its cells or more begin as such, and are no dates.
/// "5 pad bearing" is a title.
bool is_row_of_numbers(const std::string& line);

/// Whether a line below the names says something in words, and fills no row.
bool is_note(const std::vector<Cell>& cells, std::size_t columns, Delimiter delimiter);

/// Whether a line below the rows sums them up: it says so, and fills no row.
bool is_total(const std::vector<Cell>& cells, std::size_t columns);

/// Whether a line below the rows tells their means, or other numbers of all of them: it says so
/// where the line above has a number.
bool is_statistic(const std::vector<Cell>& cells, const std::vector<Cell>& above);

}  // namespace whirl::inline io
