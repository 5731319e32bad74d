#pragma once
/// The units in which people read numbers: SI with prefixes, unless other ones are asked for.
/// Result files and JSON are SI whatever is shown.
///
/// Like the width of the terminal, they are a property of the output of the whole process: texts,
/// figures and pages ask for them where a number is written.

#include <string>
#include <string_view>
#include <vector>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A unit, and how large it is.
struct ShownUnit {
  std::string name;    ///< empty: none is written
  double size = 1.0;   ///< of one such unit [SI]
  double least = 0.0;  ///< value from which it is preferred to a smaller one [SI]
};

/// A system of units, with some chosen one by one.
class ShownUnits {
 public:
  /// Reads "us", "si", "cgs", "none", "file" and units, "us,rad/s,kN". A unit stands for all that
  /// it measures; "none" shows numbers of a model without dimensions; "file" is what a model's text
  /// is written in, "us" where most of its lengths and forces are, else "si".
  /// @param model  text of the model file
  static Parsed<ShownUnits> named(std::string_view list, std::string_view model);

  /// Units to choose from by the size of a number, ascending; empty: those of SI, with prefixes.
  const std::vector<ShownUnit>* choice(std::string_view si_unit) const;

  const std::vector<ShownUnit>* choice_of(const Dimension& dimension) const;

  bool is_si() const { return choices_.empty() && !is_bare_; }

 private:
  struct Choice {
    Dimension dimension;
    std::vector<ShownUnit> units;
  };
  std::vector<Choice> choices_;  // the first that fits counts
  bool is_bare_ = false;         // "none"
  std::vector<ShownUnit> bare_{{"", 1.0, 0.0}};
};

/// Those in use; SI at first.
const ShownUnits& shown_units();

/// Uses other units from now on.
void show_in(ShownUnits units);

/// The unit in which a column of numbers is shown that is told in some unit: that unit itself in
/// SI, else the nearest in size: "um" -> "mil", "kN" -> "lbf", "rpm" -> "rpm".
/// @throws std::invalid_argument  if there is no such unit
ShownUnit shown_unit(std::string_view unit);

/// The unit of speeds: rpm unless another one is asked for.
ShownUnit speed_unit();

/// A number [SI] in the shown unit of `unit`, without the name of the unit: "-" for NaN.
/// @param format  as fmt has it for a number in `unit`, ".3f"; the shown unit has as many more or
///                fewer digits behind the point as keep the resolution
std::string shown_number(double value, std::string_view unit, std::string_view format);

/// A number [SI] in the shown unit of `unit` to some significant digits: "-" where it is not
/// finite, zero without a sign.
std::string shown_digits(double value, std::string_view unit, int digits = 5);

/// The same as shown_number() with the name of the unit: "3600.0 rpm".
std::string shown_value(double value, std::string_view unit, std::string_view format);

/// A heading with the shown unit: "largest [mil]".
std::string shown_heading(std::string_view what, std::string_view unit);

/// A format for numbers in another unit, with about the same resolution: ".1f" of mm is ".2f" of
/// in.
/// @param ratio  size of the new unit over that of the old one
std::string format_for(std::string_view format, double ratio);

}  // namespace whirl::inline io
