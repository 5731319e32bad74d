#pragma once
/// Quantities as people like to read them; units.hpp reads them back.

#include <string>
#include <string_view>

namespace whirl::inline io {

/// A value with an engineer's prefix, to four significant digits or as many as are asked for.
///
///   format_engineering(4e6, "N/m") = "4 MN/m",   format_engineering(5e-4, "m") = "500 um"
///
/// Where other units than those of SI are shown (shown_units.hpp) it is told in these.
///
/// A prefix goes to a leading m, N, Pa or rad without exponent, and to s alone. Masses are given in
/// mg, g, kg and unbalances in g.mm, kg.mm, kg.m; any other unit stays as it is.
///
/// @param value    [si_unit]; NaN and infinity are written as such
/// @param si_unit  as in dimension_of; empty for a plain number
/// @param digits   1 to 10
std::string format_engineering(double value, std::string_view si_unit, int digits = 4);

/// A number by a format of fmt, ".2f", zero without a sign unless the format has one; "-" for NaN.
std::string format_number(double value, std::string_view format);

/// A length [m]: "500 um", "20 mm", "1.2 m".
std::string format_length(double value);

/// A number to four digits at least, whole from 1000 on, of five digits or more with blanks between
/// thousands: "3000", "28 648".
std::string format_grouped(double value);

/// "1e-6", "2.5e-7"
std::string format_tolerance(double tolerance);

/// A speed [rad/s], in revolutions per minute if no other unit is shown: "3650 rpm".
std::string format_speed(double value);

}  // namespace whirl::inline io
