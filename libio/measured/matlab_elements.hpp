#pragma once
/// What MATLAB files of level 5 are made of: elements within elements, each with its size.

#include <string>

namespace whirl::inline io {

/// Checks that a file has all values that its variables say to have. matio, which reads them, fills
/// what is missing from wherever its memory was used before, or with zeros.
///
/// Files of level 4 and 7.3, and what is no MATLAB file at all, are left to matio.
///
/// @param bytes  of the whole file
/// @param file   for messages
/// @throws ModelError  names the variable that is cut off, and how many values it has
/// @source MathWorks, MAT-File Format, version 5
void require_whole_variables(const std::string& bytes, const std::string& file);

}  // namespace whirl::inline io
