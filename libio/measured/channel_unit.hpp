#pragma once
/// Units of channels, among them voltages, which models do not have.

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "libdata/measured/probe_readings.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A unit as records have it.
struct ChannelUnit {
  std::string name;     ///< "m", "V", any other as it is written, or ""
  double factor = 1.0;  ///< from the unit as written
};

/// The unit that a text means: m for lengths, V for voltages; any other unit stays as it is.
ChannelUnit channel_unit(std::string_view text);

/// A number in the unit of a channel, "-5 V", "0.5"; nothing: the text is no such number.
std::optional<std::pair<double, ChannelUnit>> channel_value(std::string_view text);

/// A gain: "7.87 V/mm", "-8 mV/um", "200 mV/mil"; "0.787 1/mm" of channels without unit; a plain
/// number where channels are lengths.
Parsed<ProbeGain> parse_gain(const std::string& text);

}  // namespace whirl::inline io
