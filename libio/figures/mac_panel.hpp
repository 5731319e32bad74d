#pragma once

#include <optional>

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Peaks of a motion against the modes, as cells; nothing for a result without peaks.
std::optional<Panel> mac_panel(const ResultView& result);

}  // namespace whirl::inline io::figures
