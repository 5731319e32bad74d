#pragma once
/// What options say about records of measurements.

#include <string>
#include <vector>

#include "libdata/fit/measured_fit.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Samples per second, as a number or a frequency [1/s].
Parsed<double> parse_sampling_rate(const std::string& text);

/// A frequency or a speed [rad/s].
Parsed<double> parse_frequency(const std::string& text);

/// A length above zero [m].
Parsed<double> parse_length(const std::string& text);

/// Multiples of the speed above zero, with commas between, each once.
Parsed<std::vector<double>> parse_orders(const std::string& text);

/// A number of revolutions, 0 or more.
Parsed<double> parse_revolutions(const std::string& text);

/// A standard deviation of noise, of that of a signal: 1% or 0.01.
Parsed<double> parse_noise_share(const std::string& text);

/// A length, or a share of what a probe reads such as 1%.
Parsed<ProbeNoise> parse_probe_noise(const std::string& text);

}  // namespace whirl::inline io
