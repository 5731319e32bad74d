#pragma once
/// What a person wants otherwise in a figure, of any kind: ranges, scales, names, panels, markers.

#include <string>
#include <vector>

#include "libio/drawing/figure.hpp"

namespace whirl::inline io {

/// Texts as the options of `whirl plot` have them; empty: as the figure is made.
///
/// A range is A:B, A: or :B, A below B. Numbers without a unit are those along the axis; a unit at
/// the end holds for both. One range with a unit is for all panels whose axis measures that; one
/// without, and one name, is for the first panel and those whose axis has the same name. Several
/// ranges, divided by commas, or names, divided by semicolons, are for the panels in their order,
/// where an empty one leaves its panel as it is.
struct FigureView {
  std::string panels{};  ///< numbers from 1, or parts of names, divided by commas: what is kept
  std::string x_range{}, y_range{};
  std::string log{};  ///< "x", "y", "xy", or "none": linear axes
  std::string x_label{}, y_label{};
  /// Names in the legend in their order, divided by semicolons, or OLD=NEW for any name in the
  /// figure.
  std::string labels{};
  std::string title{};
  std::string marker{};      ///< of points: "circle", "square", ... or as matplotlib has them
  double marker_size = 0.0;  ///< [pixels]; 0: as it is
};

/// Changes a figure to what is wanted.
///
/// A logarithmic axis has no place for numbers of 0 or less: negative ones within the range are a
/// problem; points at 0, as the response at rest, are left out and told.
///
/// @return  what is to be told
/// @throws ModelError  naming the option and saying what would be right: for what cannot be read, a
///                     unit that no axis has, a range in which there is nothing, and an axis that
///                     cannot be logarithmic
std::vector<std::string> change_view(Figure& figure, const FigureView& view);

}  // namespace whirl::inline io
