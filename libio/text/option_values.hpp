#pragma once
/// Values of options: what a text says, or what would be right.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/structs/field.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// The error of an option that means nothing.
/// @param option   without dashes
/// @param value    as it was given; empty: not given
/// @param problem  what would be right
ModelError wrong_option(const std::string& option, const std::string& value, std::string problem);

/// Value of an option, as read by a function that gives a Parsed.
/// @throws ModelError  naming the option and its value, if it means nothing
template <class Parse>
auto parsed_option(const std::string& option, const std::string& value, const Parse& parse) {
  const auto found = parse(value);
  if (!found) throw wrong_option(option, value, found.problem);
  return *found;
}

/// What is wrong with the name of a file that is written; empty: nothing. Wrong is an ending that
/// says another format than the file will have, and "-", which is no file.
/// @param endings  that are right, ".json .txt"; empty: the format is as the ending says. An ending
///                 that says no format, and a name without an ending, are right in any case.
std::string ending_problem(std::string_view file, std::string_view endings);

/// A whole number from `least` to `most`.
Parsed<long> parse_whole(std::string_view text, long least, long most);
/// "1 to 100 000", "4 to 10 million"
std::string range_text(long least, long most);

/// Tolerance of an integrator's step.
Parsed<double> parse_tolerance(std::string_view text);
/// How well an exponent is to be known [1/revolution].
Parsed<double> parse_resolution(std::string_view text);

/// A time above 0 [s], with its unit or in seconds.
Parsed<double> parse_duration(std::string_view text);

/// Name of one of these integrators, or "cvode".
Parsed<std::string> parse_method(const std::string& name,
                                 const std::vector<std::string_view>& methods);

/// Name of one of these instruction sets, one at least.
Parsed<std::string> parse_instruction_set(const std::string& name,
                                          const std::vector<std::string>& sets);

/// Speeds of linear analyses [rad/s]; a range without a step has 101.
Parsed<std::vector<double>> parse_speeds(std::string_view text);
/// Frequencies of responses [rad/s]; a range without a step has 401.
Parsed<std::vector<double>> parse_frequencies(std::string_view text);
/// Speeds where none are given: from zero to somewhat above the operating speed [rad/s] (0: none).
std::vector<double> usual_speeds(double operating_speed);

/// The speeds that --over goes through, at least the first and the last [rad/s].
/// @param otherwise  speed where --over varies none
std::vector<double> speeds_over(const std::vector<std::string>& over, double otherwise);

/// "expected stationary or rotating", "expected svg, png or pdf"
/// @param names  two or more
std::string expected_one_of(const std::vector<std::string_view>& names);

/// The choice of a name, of an enumeration with `choices`.
template <class Enum>
Parsed<Enum> parse_choice(std::string_view text) {
  if (const auto value = value_named<Enum>(text)) return *value;
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices(Enum{})) names.push_back(name);
  return Parsed<Enum>::failed(expected_one_of(names));
}

}  // namespace whirl::inline io
