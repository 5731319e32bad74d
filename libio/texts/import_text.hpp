#pragma once

#include <string>

#include "libio/import/import_file.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

/// What became of a rotor of another program: parts, files, what was left out or taken differently.
std::string text_of(const Imported& imported);

/// files, left_out, taken_differently
Record record_of(const Imported& imported);

}  // namespace whirl::inline io
