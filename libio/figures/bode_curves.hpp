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
};

/// Adds what a probe reads to the curves of its unit.
void add_reading(const ProbeLabel& probe, const CVec& reading, std::vector<BodeCurves>& to);

/// Rows of stations with a name (disks, bearings, contacts), or of all if none has.
std::vector<Eigen::Index> named_rows(const std::vector<std::string>& stations);

/// Amplitude, peak to peak, over phase, without a table and texts.
/// @param speed  ascending [rpm]
Figure bode_figure(const ResultView& result, const std::vector<double>& speed,
                   const BodeCurves& shown);

/// The complex amplitude of one curve in its plane, peak to peak, with speeds along the loop.
/// @param speed  [rpm]
Figure polar_figure(const std::vector<double>& speed, const std::string& name, const CVec& a,
                    const DisplayUnit& unit);

}  // namespace whirl::inline io::figures
