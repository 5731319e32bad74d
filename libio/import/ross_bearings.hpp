#pragma once
/// Bearings and seals of ROSS, of any class.

#include <string_view>

#include "libio/import/ross.hpp"
#include "libio/import/ross_section.hpp"

namespace whirl::inline io {

/// Reads a bearing or seal by its coefficients. Magnets and their controller are read, too, where
/// the coefficients are theirs.
void read_ross_bearing(const RossSection& section, RossRotor& rotor, bool is_before_3,
                       UnreadKeys& unread);

/// Tells that coefficients are left out, where any of them is not zero.
void leave_out(const RossSection& section, std::string_view key, std::string_view why,
               RossRotor& rotor);

}  // namespace whirl::inline io
