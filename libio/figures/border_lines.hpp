#pragma once
/// Curves of bifurcations in a plane of two parameters, in their own figure and over maps.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// A curve of bifurcations, both ways from where it begins.
struct Border {
  std::string kind, contact;
  double period = 1.0;              ///< [revolutions]
  std::vector<std::string> ends;    ///< why
  std::vector<std::size_t> points;  ///< their numbers among those of all borders
  std::string name{};               ///< "3 grazing of ring"
};

/// Borders, and all of their points one after another, as the axes show them.
struct BorderPoints {
  explicit BorderPoints(const ResultView& result);
  ShownAxis first, second;
  std::vector<double> stable;  ///< per point, 0: other multipliers are outside of the circle
  std::vector<Border> borders;
};

/// The borders as curves, in color and dashes by their kind; thin where other multipliers are outside
/// of the unit circle.
///
/// @param x,y  of all points
std::vector<Curve> border_curves(const BorderPoints& borders, const std::vector<double>& x,
                                 const std::vector<double>& y);

}  // namespace whirl::inline io::figures
