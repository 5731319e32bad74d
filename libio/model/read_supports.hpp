#pragma once
/// Keys of bearings, seals and links.

#include <vector>

#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// All bearings or seals.
void read_supports(ModelReading& reading, const char* array, std::vector<Connection>& to);

/// The keys of a kind of coefficients.
/// @return  whether any is there
bool read_coefficients(ModelReading& reading, TableReader& table, AnyBearing& to);

}  // namespace whirl::inline io
