#pragma once

#include <string>

#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdyn/motions/identify.hpp"

namespace whirl::inline io {

/// Table of peaks against modes, the best mode of a peak beside it; the resonance below.
/// @param Omega      speed of the rotor [rad/s]
/// @param has_sense  whether frequencies have a sense of whirl
/// @param told_like  a probe in whose unit amplitudes are told; null: with an engineer's prefix
std::string text_of(const Identification& found, double Omega, bool has_sense = true,
                    const ProbeLabel* told_like = nullptr);

/// A probe in whose unit all readings are told; null: their units differ.
const ProbeLabel* probe_told_like(const MeasuredIdentification& measured);

/// What was measured: probes, speed and length of the record.
std::string text_of(const MeasuredIdentification& measured);

/// Deflection shapes at the strongest peaks, a row for each probe; empty: there is only one probe.
std::string deflection_text(const MeasuredIdentification& measured);

/// Orders along a record: where each is largest.
std::string text_of(const OrderTracking& tracking);

/// Modes that no probe sees, and those that look alike at the probes; empty: there are none.
std::string doubt_text(const MeasuredIdentification& measured);

}  // namespace whirl::inline io
