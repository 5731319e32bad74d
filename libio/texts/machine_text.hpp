#pragma once
/// What is told of a machine in operation: its trend, its zones, its 1X shapes.

#include <string>

#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/trend.hpp"
#include "libdata/measured/zones.hpp"

namespace whirl::inline io {

/// First, last and largest readings of every probe.
std::string text_of(const Trend& trend);

/// The zone of every probe, with its boundaries.
std::string text_of(const ZoneReport& zones);

/// Shapes at the peaks of 1X beside modes; empty: there are none.
std::string shapes_text(const OrderTracking& tracking);

/// What the model's curve is; empty: there is none.
std::string model_curve_text(const OrderTracking& tracking);

/// What a reader of the verdict has to know.
std::vector<std::string> notes_of(const ZoneReport& zones);

}  // namespace whirl::inline io
