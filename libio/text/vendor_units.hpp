#pragma once
/// Units as tables of vendors write them, which differ from the units of model files.

#include <string>
#include <string_view>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// The unit that a text means where `si_unit` is expected, in the spelling of parse_as.
///
///   "lb/in" -> "lbf/in",  "klb-s/in" -> "klbf.s/in",  "RPM", "cpm", "1/min" -> "rpm",
///   "N/(m/s)" -> "N/m.s"
///
/// A unit that fits as it stands is left so. Pounds are forces where
/// these fit, else masses: "lb-in^2" is a moment of inertia.
///
/// @return  or what is wrong with the text as it stands
Parsed<std::string> unit_in_table(std::string_view text, std::string_view si_unit);

/// What a quantity with a unit of vendors may mean: "; did you mean "5 lbf/in"?", or nothing.
std::string vendor_hint(const std::string& quantity, std::string_view si_unit);

}  // namespace whirl::inline io
