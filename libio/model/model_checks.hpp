#pragma once

#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// Checks places, masses and radii of a model that has been read, which only its mesh knows.
/// Contacts without a radius get that of the shaft.
void check_places(ModelReading& reading);

}  // namespace whirl::inline io
