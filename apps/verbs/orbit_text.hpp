#pragma once
/// What `whirl orbit` says of an orbit in the stationary frame.

#include <string>

#include "libdyn/studies/found_orbit.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline cli {

/// Entries of the orbit, from `period_revs` to `harmonic_balance`.
void add_orbit(Record& record, const FoundOrbit& orbit);

/// The same for people, of one that was found.
std::string orbit_text(const FoundOrbit& orbit);

/// `floquet` entry: complex numbers as pairs.
Record complex_list(const CVec& numbers);

}  // namespace whirl::inline cli
