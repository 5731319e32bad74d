#pragma once
/// Full spectra, simulated or measured.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// A full spectrum, backward left, forward right, with its strongest lines in orders.
/// @param frequency  signed, ascending [rad/s]
/// @param amplitude  radius per line, one at least above zero [m or rad]
/// @param unit       that they are shown in
Figure full_spectrum(const ResultView& result, const std::string& station, const Vec& frequency,
                     const Vec& amplitude, const DisplayUnit& unit);

}  // namespace whirl::inline io::figures
