#pragma once
/// Modes, critical speeds and Campbell diagrams for people.

#include <string>

#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline io {

/// The table of the oscillatory modes; overdamped and rigid-body ones below it.
std::string text_of(const Modes& modes);

std::string text_of(const CriticalSpeeds& found);

/// Frequencies and logarithmic decrements of the branches, a table each, for some twenty of the
/// speeds; critical speeds, and what was not computed.
std::string text_of(const Campbell& diagram);

}  // namespace whirl::inline io
