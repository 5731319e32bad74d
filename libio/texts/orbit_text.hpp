#pragma once
/// Periodic orbits for people.

#include <string>

#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/orbit_search.hpp"

namespace whirl::inline io {

/// How an orbit was found, how well, and its multipliers; empty where none was found.
std::string text_of(const FoundOrbit& orbit);
std::string text_of(const RotatingOrbit& orbit);

/// The orbits that random starts led to, a line each.
std::string text_of(const OrbitSearch& search);

}  // namespace whirl::inline io
