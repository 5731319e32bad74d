#pragma once
/// Units: from text to SI (format.hpp goes the other way). Everything behind this file is SI, with
/// angles in rad and speeds in rad/s.
///
///   quantity = number [blanks] [unit]
///   unit     = ["1" "/"] factor { ("." | "*" | "/" | blanks) factor }
///   factor   = [prefix] symbol [["^"] exponent]
///
/// "/" divides by the next factor; an exponent is a multiple of a half.
///
/// Also understood: the signs for micro, degree, product dot, superscript 2 and 3.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// Powers of the base units. Angle is one of them, so that 50 Hz and 50 rad/s are not mixed up.
struct Dimension {
  std::array<int, 6> twice{};  ///< twice the exponents of kg, m, s, K, rad, A: N/m^1.5 needs halves

  bool operator==(const Dimension&) const = default;
};

/// A number in SI and what it measures.
struct Quantity {
  double value = 0.0;  ///< [SI], finite
  Dimension dimension;
  std::string unit;  ///< as written; empty: a bare number, which is SI wherever it stands
};

/// A value, or what is wrong with the text it was to come from.
template <class T>
struct Parsed {
  std::optional<T> value;
  std::string problem;  ///< for the person who wrote the text; empty if there is a value

  Parsed(T result) : value(std::move(result)) {}
  static Parsed failed(std::string problem) { return Parsed(std::move(problem), 0); }

  explicit operator bool() const { return value.has_value(); }
  const T& operator*() const { return *value; }
  const T* operator->() const { return &*value; }

 private:
  Parsed(std::string what, int) : problem(std::move(what)) {}
};

/// Reads a number with or without unit: "20 mm", "4e6N/m", "2.333e10 N/m^1.5", "12".
///
/// Hz is revolutions per second, 2 pi rad/s. Problems: no number, no finite number, an unknown unit
/// (with the nearest known one), an exponent that is not a multiple of a half.
Parsed<Quantity> parse_quantity(std::string_view text);

/// Reads a value for a place where `si_unit` is expected; a bare number is SI.
///
///   parse_as("3650 rpm", "rad/s") = 382.2,   parse_as("4 MN/mm^2", "N/m"): problem
///
/// Angle counts, with one exception: N.m/rad and N.m stand for each other, and so do N.m.s/rad
/// and N.m.s.
///
/// @param si_unit  as in dimension_of
/// @return         value [si_unit], or a problem such as
///                 found "4 MN/mm^2", expected a stiffness (N/m)
/// @throws std::invalid_argument  if si_unit is none
Parsed<double> parse_as(std::string_view text, std::string_view si_unit);

/// Dimension of an SI unit as field tables write it: "N/m^1.5", "rad/s", "1/s"; "": a plain number.
/// @throws std::invalid_argument  if it is not a unit, or not one without a factor (mm, rpm)
Dimension dimension_of(std::string_view si_unit);

/// All symbols of units, plain ones first, then with prefixes.
const std::vector<std::string>& unit_symbols();

/// What a unit measures: "stiffness" for N/m; empty if it has no name.
std::string_view quantity_name(const Dimension& dimension);

/// What is expected, in words: "a stiffness (N/m)", "a value in kg^2.m", "a number without unit".
std::string expected_quantity(std::string_view si_unit);

/// Text in quotation marks for a message; long texts are cut, control characters become blanks.
std::string in_quotes(std::string_view text);

}  // namespace whirl::inline io
