#pragma once
/// Amplitude over phase, and loops, of responses to unbalance and to forces of other frequencies,
/// and of orders of measurements.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Complex amplitudes over speed that one figure shows.
struct BodeCurves {
  std::vector<std::string> names;
  CMat a;  ///< curves x speeds [m]; what is not bounded is NaN
  DisplayUnit unit;
  std::vector<std::string> probes;  ///< probes that the curves are of
  std::vector<double> angles{};     ///< of these probes, from +x towards +y [rad]
};

/// The complex amplitude of a reading over speed.
struct PolarCurve {
  std::string name;
  CVec a;  ///< at each speed [m]
  DisplayUnit unit;
  std::string mark;            ///< of the probe, or of the direction that is read: "DE 1X", "x"
  double angle = 0.0;          ///< where it is, from +x towards +y [rad]
  double operating = not_set;  ///< speed that is marked [speed_unit()]; NaN: none
};

/// Adds what a probe reads to the curves of its unit.
void add_reading(const ProbeLabel& probe, const CVec& reading, std::vector<BodeCurves>& to);

/// Rows of stations with a name (disks, bearings, contacts), or of all if none has.
std::vector<Eigen::Index> named_rows(const std::vector<std::string>& stations);

/// Amplitude, peak to peak, over phase lag within 180 degrees, without a table and texts. A lag is
/// positive where the reading is late, as instruments show it; the phases of results are leads.
/// @param speed  ascending, of measurements in any order [speed_unit()]
Figure bode_figure(const ResultView& result, const std::vector<double>& speed,
                   const BodeCurves& shown);

/// A polar plot, peak to peak, with speeds along the loop: amplitudes at the place of the high spot
/// at phase 0, that is at the probe's angle less the lag, seen as orbits are. Around it are the
/// lags every 30 degrees, the probe, and the direction of rotation.
///
/// @param speed   [speed_unit()]
/// @source [API684], polar plots of vibration at the running speed
Figure polar_figure(const std::vector<double>& speed, const PolarCurve& shown);

}  // namespace whirl::inline io::figures
