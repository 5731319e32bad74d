#pragma once
/// State spaces as tables of their matrices.

#include <optional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/linalg.hpp"

namespace whirl::inline io {

/// z' = A z + B u, f = C z + D u; nothing: a matrix is not told.
struct StateSpaceTable {
  std::optional<Mat> A, B, C, D;
};

/// Reads a table with a line for each row of a matrix: its letter, then the numbers of the row.
///
///   A, -125, -1.25e6
///   A, 1, 0
///   B, 1
///   B, 0
///   C, 0, -2.5e11
///   D, 1e6
///
/// Commas, semicolons, tabs or blanks stand between the cells; lines that begin with # are
/// comments. Or the matrix [A, B; C, D] in MatrixMarket's form, with a comment that says how many
/// rows and columns A has: "% states 2".
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its place
StateSpaceTable parse_state_space_table(const std::string& text, const std::string& file,
                                        std::vector<Problem>& problems);

/// The same matrices as a text, with all digits; matrices without entries are left out.
std::string state_space_text(const StateSpaceTable& table);

}  // namespace whirl::inline io
