#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Values of a parameter as the command line gives them, first:last:step or first:last.
struct ValueRange {
  double first = 0.0, last = 0.0;  ///< [SI], finite, first <= last
  std::optional<double> step;      ///< [SI], > 0, for up to a million values; none: not given
};

/// Reads a range: parse_range("0:8000:50rpm", "rad/s").
///
/// A unit at the end holds for all parts that have none of their own; bare numbers are SI. A unit
/// in front of a part without one is a problem, since either reading would surprise somebody.
///
/// @param si_unit  unit of the parts, as in dimension_of
Parsed<ValueRange> parse_range(std::string_view text, std::string_view si_unit);

/// The same where only the dimension of the parts is known.
Parsed<ValueRange> parse_range(std::string_view text, const Dimension& dimension);

/// first, first + step, ...; the last value belongs to them, exactly, if it is met to 1e-9 steps.
/// @param range  with a step
std::vector<double> values(const ValueRange& range);

/// `points` equally spaced values from first to last, both included; any step is ignored.
/// @param points  >= 2, or 1 for the first alone
std::vector<double> values(const ValueRange& range, int points);

}  // namespace whirl::inline io
