#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libbase/structs/parameter_name.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// What a study varies in a model, and the values it takes.
struct ParameterAxis {
  /// Path such as contact.seal.friction. Several paths, with commas between, all have the value; a
  /// path with a minus before it has the negative value.
  std::string path;
  std::string unit;            ///< SI unit of the values; empty: none was written
  std::vector<double> values;  ///< [SI]
  std::string shown_unit;      ///< unit as it was written, for people
  double shown_scale = 1.0;    ///< SI units in one shown unit

  double shown(std::size_t index) const { return values[index] / shown_scale; }
  /// "operation.speed [rpm]"
  std::string title() const { return shown_unit.empty() ? path : path + " [" + shown_unit + "]"; }

  ParameterName name() const { return {path, unit}; }

  /// Its paths, one by one, without signs.
  std::vector<std::string> paths() const;
  /// Whether one of its paths is this one.
  bool has(const std::string& one) const;
  /// A value [SI], as --set takes it, for every path.
  std::vector<std::string> assignments_of(double value) const;
  /// The same of the value at an index.
  std::vector<std::string> assignments(std::size_t index) const {
    return assignments_of(values[index]);
  }

  static constexpr auto columns() {
    using A = ParameterAxis;
    return ColumnList{column("parameter", &A::path, "", "path of the value in the model"),
                      column("unit", &A::unit, "", "SI unit of the values"),
                      column("values", &A::values, "", "that it takes")};
  }
};

/// "operation.speed [rad/s]"
std::string label_of(const ParameterName& name);

/// Reads what --over says: PATH=first:last:step (or PATH,PATH,...=first:last:step), PATH=first:last
/// with a number of points, or PATH=value,value,...
///
/// A unit at the end holds for all parts that have none of their own; bare numbers are SI.
///
/// @param points  of a range without a step; 0: it must have one
Parsed<ParameterAxis> parse_axis(std::string_view text, int points);

/// Reads all axes.
/// @param least, most  how many are right
/// @throws ModelError  naming an axis that is wrong, or saying how many axes, or points in all,
///                     there should be
std::vector<ParameterAxis> parse_axes(const std::vector<std::string>& texts, int points,
                                      std::size_t least, std::size_t most);

/// Parts of a text between the occurrences of a character; one part more than occurrences.
std::vector<std::string> split(std::string_view text, char at);

}  // namespace whirl::inline io
