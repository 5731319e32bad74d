#pragma once
/// Figures of motions along displacement probes.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Whether readings of a probe are drawn: see ResultView::probe.
bool is_drawn(const ResultView& result, const ProbeLabel& probe);

/// Numbers of the probes of a result whose readings are drawn.
std::vector<std::size_t> drawn_probes(const ResultView& result, const ProbeLabels& probes);

/// The probe of a name in the model of a result; null if there is none.
const Probe* probe_of(const ResultView& result, const std::string& name);

/// What the probes of a result read in time; none without probes.
std::vector<Figure> probe_histories(const ResultView& result);

/// Spectra of what the probes of a result read, peak to peak, a figure for each unit of probes.
std::vector<Figure> probe_spectra(const ResultView& result);

/// What the probes of a result read once a revolution, in time and from one revolution to the next,
/// a figure for each probe.
std::vector<Figure> probe_sections(const ResultView& result);

/// Probes at a recorded station of the trajectory ("7 left bearing"), without axial ones.
std::vector<Probe> probes_at(const ResultView& result, const std::string& station);

/// Where probes stand around an orbit of a size [m], seen from the ground.
/// @param factor  of lengths in the panel
void add_probes(const std::vector<Probe>& probes, double size, double factor, Panel& panel);

}  // namespace whirl::inline io::figures
