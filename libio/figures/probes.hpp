#pragma once
/// Figures of motions along displacement probes.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// What the probes of a result read in time; none without probes.
std::vector<Figure> probe_histories(const ResultView& result);

/// Spectra of what they read, peak to peak, a figure for each of their units.
std::vector<Figure> probe_spectra(const ResultView& result);

/// Probes at a recorded station of the trajectory ("7 left bearing").
std::vector<Probe> probes_at(const ResultView& result, const std::string& station);

/// Where probes stand around an orbit of a size [m], seen from the ground.
/// @param factor  of lengths in the panel
void add_probes(const std::vector<Probe>& probes, double size, double factor, Panel& panel);

}  // namespace whirl::inline io::figures
