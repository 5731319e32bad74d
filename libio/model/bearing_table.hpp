#pragma once

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/bearings/coefficient_table.hpp"

namespace whirl::inline io {

/// Reads bearing coefficients against speed from CSV.
///
/// The first line that is not a comment (#) names the columns: `speed` and any of kxx, kxy, kyx,
/// kyy, cxx, cxy, cyx, cyy, and the same for tilts with a t (ktxx, ctxx, ...); what is absent is
/// zero. A unit may follow in brackets, "speed [rpm]"; without one, SI. Speeds must ascend.
///
/// @param file      for messages
/// @param problems  receives what is wrong, with file and line
CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems);

}  // namespace whirl::inline io
