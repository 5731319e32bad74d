#pragma once
/// What a periodic motion does at stations, and what it costs in energy.

#include <span>
#include <vector>

#include "libbase/numerics/fourier.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/orbits/orbit_frame.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

struct OrbitMeasure {
  std::vector<double> radii;  ///< largest distance of each station from the axis [m]
  /// Work that unbalance and forces do in a revolution: what damping, contacts and films take, less
  /// what friction at the rim brings in from the spin [J].
  double work = 0.0;
  /// Largest less smallest reading of each probe of the model over the period [m]. An orbit that
  /// repeats as seen from the rotor brings all of its places by the probe over a long time: the
  /// reading is twice the largest distance from the axis. Radii and readings are those of ten
  /// instants a step of the integrator, or eight a harmonic.
  std::vector<double> probe_peak_to_peak;
  Mat sections;  ///< x and y of the stations in turn (rows) after every whole revolution (columns)
                 ///< [m]
};

/// Measures the motion from a state at phase 0.
/// @param revolutions  period of the motion, any positive number
/// @param frame        in which the motion repeats
OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations, const Vec& y,
                           double revolutions, OrbitFrame frame = OrbitFrame::stationary);

/// Measures a Fourier series of the reduced displacements.
OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations,
                           const Periodic& motion);

/// What a probe reads of an orbit, as a row of a result.
struct OrbitProbe : ProbeLabel {
  double peak_to_peak = 0.0;  ///< as of OrbitMeasure [m]

  static constexpr auto columns() {
    return joined(
        ProbeLabel::columns(),
        ColumnList{column("peak_to_peak", &OrbitProbe::peak_to_peak, "m", "of the reading")});
  }
};

/// Readings of the probes of a scene's model on an orbit, see measure_orbit; empty without probes.
std::vector<OrbitProbe> probes_along(const Scene& scene, const Vec& y, double revolutions,
                                     OrbitFrame frame = OrbitFrame::stationary);
std::vector<OrbitProbe> probes_along(const Scene& scene, const Periodic& motion);

}  // namespace whirl::inline dyn
