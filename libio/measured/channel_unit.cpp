#include "libio/measured/channel_unit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/text/delimited.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

/// Volts of a unit of voltage.
std::optional<double> volts(std::string_view unit) {
  for (const std::string_view word : {"Volt", "Volts", "volt", "volts"}) {
    if (unit == word) return 1.0;
  }
  if (!unit.ends_with('V')) return std::nullopt;
  const std::string_view prefix = unit.substr(0, unit.size() - 1);
  if (prefix.empty()) return 1.0;
  if (prefix == "k") return 1e3;
  if (prefix == "m") return 1e-3;
  if (prefix == "u" || prefix == "µ" || prefix == "μ") return 1e-6;
  return std::nullopt;
}

}  // namespace

ChannelUnit channel_unit(std::string_view text) {
  const std::string unit = trimmed(text);
  if (unit.empty() || unit == "-") return {};
  if (const auto factor = volts(unit)) return {"V", *factor};
  if (const auto name = unit_in_table(unit, "m")) {
    if (const auto length = parse_as("1 " + *name, "m")) return {"m", *length};
  }
  return {unit, 1.0};
}

std::optional<std::pair<double, ChannelUnit>> channel_value(std::string_view text) {
  const auto letter = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  const auto number = parse_as(text.substr(0, letter), "");
  if (!number) return std::nullopt;
  const ChannelUnit unit = channel_unit(text.substr(letter));
  return std::pair(*number * unit.factor, unit);
}

Parsed<ProbeGain> parse_gain(const std::string& text) {
  using Result = Parsed<ProbeGain>;
  const auto wrong = [&] {
    return Result::failed(fmt::format(
        "found {}, expected what the channel gives per displacement, such as \"7.87 V/mm\", or a "
        "number, and not zero",
        in_quotes(text)));
  };
  ProbeGain gain;
  const auto slash = text.find('/');
  const std::string left = trimmed(std::string_view(text).substr(0, slash));
  const auto unit_at = left.find_last_not_of("VkmuµμV");
  if (slash != std::string::npos && left.ends_with('V') && unit_at != std::string::npos) {
    const auto number = parse_as(left.substr(0, unit_at + 1), "");
    const auto factor = volts(trimmed(std::string_view(left).substr(unit_at + 1)));
    const auto length = parse_as("1 " + trimmed(std::string_view(text).substr(slash + 1)), "m");
    if (!number || !factor || !length) return wrong();
    gain = {ProbeGain::Of::voltage, *number * *factor / *length};
  } else if (const auto number = parse_as(text, "")) {
    gain = {ProbeGain::Of::length, *number};
  } else if (const auto per_length = parse_as(text, "1/m")) {
    gain = {ProbeGain::Of::number, *per_length};
  } else {
    return wrong();
  }
  if (gain.value == 0.0) return wrong();
  return gain;
}

}  // namespace whirl::inline io
