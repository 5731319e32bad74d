#pragma once
/// A map for people: the plane as signs, and how much of it each motion has.

#include <string>
#include <vector>

#include "libdyn/studies/map.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

/// The first plane as signs, the first axis to the right, the second one up; below it the shares of
/// motions and regimes, with three axes a column for each value of the last one.
std::string text_of(const MapResult& map, const std::vector<ParameterAxis>& axes);

}  // namespace whirl::inline io
