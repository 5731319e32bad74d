#pragma once
/// What models of ROSS's rotors are written with.

#include <array>
#include <string>

#include "libio/import/ross.hpp"

namespace whirl::inline io {

/// A number as people write it: 2.11e11 rather than 211000000000.
std::string shown_number(double value);

/// A text for a comment, which ends with its line.
std::string one_line(std::string text);

/// A matrix: one value if it is that of both directions, else each that is not zero.
std::string shown_matrix(double xx, double xy, double yx, double yy);

/// One value for both, or a list of two.
std::string shown_pair(const std::array<double, 2>& values);

/// A name as a part of that of a file.
std::string file_part(const std::string& name);

/// Coefficients as CSV; those that are zero throughout are left out.
std::string table_of(const RossBearing& bearing);

}  // namespace whirl::inline io
