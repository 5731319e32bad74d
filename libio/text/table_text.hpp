#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl::inline io {

/// Lines of equal columns; a column is set right if all its cells begin with a digit, sign or dash,
/// are empty or "·".
///
/// Where the table is wider than `limit`, heads of numbers and the widest texts are folded, and
/// columns that still find no place follow in further blocks below, the first column before them
/// again.
///
/// @param limit  columns of the terminal; 0: none
std::string table_text(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows, std::size_t limit);

}  // namespace whirl::inline io
