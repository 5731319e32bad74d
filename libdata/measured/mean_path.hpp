#pragma once
/// Where a shaft runs on the average: mean positions of revolutions, along a motion.

#include "libdata/measured/orbit_view.hpp"

namespace whirl::inline data {

/// Mean positions of a station, one for some revolutions.
struct MeanPath {
  Vec time, speed;  ///< of the middles of the revolutions [s], [rad/s]
  Vec x, y;         ///< mean position [m]
};

/// Means over whole revolutions, so that what repeats with the revolution leaves nothing.
///
///   x_k = integral of w x dt / integral of w dt,   w = 1 - cos(2 pi (t - t_k) / (t_(k+n) - t_k))
///
/// from pulse k to pulse k + n, four revolutions at least. With equal weights a pulse that is told a
/// sample late would leave its share of the orbit.
///
/// @param most  points at most; windows are half over one another, or more
MeanPath mean_path(const TurnedMotion& motion, std::size_t station, std::size_t most = 400);

}  // namespace whirl::inline data
