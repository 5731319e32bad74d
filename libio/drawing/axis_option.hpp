#pragma once
/// Ranges and scales that a person wants of the axes of a figure; see figure_view.hpp.

#include <string>
#include <vector>

#include "libio/drawing/figure.hpp"

namespace whirl::inline io {

/// Texts of --xlim, --ylim and --log.
struct AxisWishes {
  std::string x_range, y_range, log;
};

/// Changes the axes of a figure.
/// @param notes  what is to be told is added
/// @throws ModelError  as change_view
void change_axes(Figure& figure, const AxisWishes& wishes, std::vector<std::string>& notes);

/// Parts of a text between a sign; one of an empty text.
std::vector<std::string> split(const std::string& text, char sign);

}  // namespace whirl::inline io
