#pragma once
/// Texts of other programs in UTF-8.

#include <string>
#include <string_view>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A text in UTF-8, without the mark that spreadsheets begin it with.
///
/// Texts in UTF-16 begin with a mark, or have a zero beside their first letter. Bytes that are no
/// UTF-8 are those of Windows-1252, whose letters beyond ASCII are those of Latin-1.
///
/// @return  or what is wrong with a text that is in none of these
Parsed<std::string> in_utf8(std::string text);

/// A text with its letters of ASCII in lower case.
std::string lower_case(std::string_view text);

}  // namespace whirl::inline io
