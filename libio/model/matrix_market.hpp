#pragma once
/// Matrices of other programs: MatrixMarket.

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/linalg.hpp"

namespace whirl::inline io {

/// Reads a real matrix, `coordinate` or `array`, `general` or `symmetric`.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its line
/// @return          0 x 0 where something is wrong
Sparse parse_matrix_market(const std::string& text, const std::string& file,
                           std::vector<Problem>& problems);

/// The same matrix as a text, `array general`, with all digits.
std::string matrix_market_text(const Mat& A, const std::string& comment);

}  // namespace whirl::inline io
