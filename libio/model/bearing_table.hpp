#pragma once

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/bearings/coefficient_table.hpp"

namespace whirl::inline io {

/// Reads bearing coefficients against speed, whirl frequency or both.
///
/// The first line that is not a comment (#, !, %, //) names the columns in any order: `speed`,
/// `whirl` or both, and any of kxx ... kyy, cxx ... cyy, mxx ... myy (added mass), and of tilts
/// ktxx ... ktyy, ctxx ... ctyy; what is absent is zero. Names of other programs are known, too
/// (see columns_named). Units stand in brackets behind names, in a line below them, or with the
/// values; without any, SI. Commas, semicolons, tabs or blanks delimit; where commas do not,
/// decimals may have them. Speeds must ascend, or whirl frequencies where there are no speeds; rows
/// over both may come in any order. See table_lines for names in a comment.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
/// @param doubts    receives what is right and seldom meant, as a missing kyy; null: not wanted
CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems,
                                     std::vector<Problem>* doubts = nullptr);

}  // namespace whirl::inline io
