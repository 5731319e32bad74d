#pragma once

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/bearings/coefficient_table.hpp"

namespace whirl::inline io {

/// Reads bearing coefficients against speed, whirl frequency or both.
///
/// Columns in any order: `speed`, `whirl` or both, and any of kxx ... kyy, cxx ... cyy, mxx ... myy
/// (added mass), and of tilts ktxx ... ktyy, ctxx ... ctyy; what is absent is zero. Names of other
/// programs are known, too (column_names.hpp), and need a unit for speeds. See parse_delimited for
/// the form of the lines. Speeds ascend or descend, or whirl frequencies where there are no speeds;
/// rows over both may come in any order.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
/// @param doubts    receives what is right and seldom meant, as a missing kyy, and columns that are
///                  not read; null: not wanted
CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems,
                                     std::vector<Problem>* doubts = nullptr);

/// How many columns of such a table a line names.
std::size_t coefficients_named_in(const std::string& line);

}  // namespace whirl::inline io
