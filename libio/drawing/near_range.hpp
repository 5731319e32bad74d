#pragma once
/// Where most of a picture would be a line, as a few numbers are far away.

#include <optional>
#include <vector>

namespace whirl::inline io {

/// The least and the largest of some numbers that belong together, as the places of one motion.
struct Extent {
  double low = 0.0, high = 0.0;
};

/// The range of the extents near each other, which others far away would press to a line.
///
/// The size of an extent is its largest distance from the median of all ends. Extents are near if
/// their sizes are below a tenth of the largest size, and no size is between theirs and three times
/// it. They are at least a tenth of all.
///
/// @return  none where nothing is far away
std::optional<Extent> near_range(const std::vector<Extent>& extents);

}  // namespace whirl::inline io
