#pragma once
/// Geometry of a plot: where numbers lie along an axis, and its ticks.

#include <string>
#include <vector>

namespace whirl::inline io {

enum class Scale { linear, logarithmic };

struct Tick {
  double value = 0.0;
  std::string label;  ///< "0.5", "10^{−6}"; empty for a small tick between labelled ones
};

/// A range of numbers along one direction of a plot.
struct Axis {
  Scale scale = Scale::linear;
  double first = 0.0, last = 1.0;  ///< first < last; above zero if logarithmic

  /// Place of a number: 0 at first, 1 at last.
  double place(double value) const;
  /// Ticks within the range: round numbers; on a logarithmic axis with two labelled powers of ten
  /// the powers, with small ticks at 2 to 9 times each if every power is labelled.
  /// @param most  labelled ticks
  std::vector<Tick> ticks(int most) const;
};

/// Whether places and ticks of an axis can be computed: its limits are far enough apart for their
/// size and not above 1e300 (nor below 1e-300, if logarithmic).
bool can_be_drawn(const Axis& axis);

/// The axis of round limits that shows all numbers; numbers above 1e300 (or below 1e-300, if
/// logarithmic) do not count. Without any number, 0 to 1, or 1 to 10.
Axis axis_around(const std::vector<double>& values, Scale scale);

/// Places as near as possible to those wanted, in the same order, with distances between them.
///
/// @param wanted    ascending
/// @param distance  least one between neighbours
/// @return          least squares of the shifts, before all are moved to lie from low to high
std::vector<double> spread(const std::vector<double>& wanted, double distance, double low,
                           double high);

}  // namespace whirl::inline io
