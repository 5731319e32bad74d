#pragma once
/// Curves of bifurcations in a plane of two parameters, in their own figure and over maps.

#include "libdyn/studies/curve_result.hpp"
#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// A curve of bifurcations, both ways from where it begins.
struct BifurcationCurve {
  BifurcationKind kind{};
  std::string contact;
  double period = 1.0;              ///< [revolutions]
  std::vector<std::string> ends;    ///< why the curve ends there
  std::vector<std::size_t> points;  ///< their numbers among those of all curves
  std::string name{};               ///< "3 grazing of ring"
};

/// Curves of bifurcations, and all of their points one after another, as the axes show them.
struct BifurcationCurvePoints {
  explicit BifurcationCurvePoints(const ResultView& result);
  const CurveResult& of;
  ShownAxis first, second;
  std::vector<BifurcationCurve> curves;

  /// Whether another multiplier is outside of the unit circle at a point.
  bool is_thin(std::size_t i) const { return of.places[i].is_stable == 0; }
};

/// The curves as lines, in color and dashes by their kind; thin where other multipliers are outside
/// of the unit circle.
///
/// @param x,y  of all points
std::vector<Curve> bifurcation_curve_lines(const BifurcationCurvePoints& points,
                                           const std::vector<double>& x,
                                           const std::vector<double>& y);

}  // namespace whirl::inline io::figures
