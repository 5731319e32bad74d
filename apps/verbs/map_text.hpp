#pragma once
/// A map for people: the plane as signs, and how much of it each motion has.

#include <string>
#include <vector>

#include "libdyn/studies/map.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline cli {

/// The first plane as signs, the first axis to the right, the second one up.
std::string map_picture(const MapResult& map, const std::vector<ParameterAxis>& axes);

/// Shares of motions; with three axes, a column for each value of the last one.
std::string map_shares(const MapResult& map, const std::vector<ParameterAxis>& axes);

}  // namespace whirl::inline cli
