#pragma once
/// Motions of results with the revolutions of the rotor, of records and of simulations alike.

#include <optional>
#include <string>
#include <vector>

#include "libdata/measured/orbit_view.hpp"
#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// The motion of a result, as figures draw it.
struct DrawnMotion {
  TurnedMotion motion;
  bool is_measured = false;             ///< from a record; else a simulation
  double slowest = 0.0, fastest = 0.0;  ///< speeds of revolutions [rad/s]

  const StationMotion& station(std::size_t i) const { return *motion.stations.at(i); }
  /// Whether the speed changes so much that a motion is one at several speeds.
  bool is_run_up() const { return fastest - slowest > 0.1 * fastest; }
  /// Time of a moment, and the speed there.
  double end() const { return motion.clock.last(); }
};

/// The motion of the record of a result, or else of its simulation.
/// @return  nothing where there is none, or the rotor makes less than three revolutions
/// @throws FileError  if the motion is not of its times
std::optional<DrawnMotion> drawn_motion(const ResultView& result);

/// The probes that a station of a record or of a simulation has; none: there are none.
std::vector<Probe> probes_of_station(const ResultView& result, const DrawnMotion& motion,
                                     const std::string& station);

/// The unit in which a station's motion is told: that of its probes, or one in which a number reads
/// well.
/// @param largest  that is told [m]
DisplayUnit unit_of_station(const std::vector<Probe>& probes, double largest);

/// Datasets of motions: a figure of either needs one of them.
std::vector<std::string> motion_datasets();

}  // namespace whirl::inline io::figures
