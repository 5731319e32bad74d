#pragma once
/// What a periodic motion does at stations, and what it costs in energy.

#include <span>
#include <vector>

#include "libbase/fourier.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

struct OrbitMeasure {
  std::vector<double> radii;  ///< largest distance of each station from the axis [m]
  /// Work that unbalance and forces do in a revolution: what damping, contacts and films take, less what
  /// friction at the rim brings in from the spin [J].
  double work = 0.0;
  /// Largest reading of each probe of the model less its smallest, over the period [m]. As the radii, of
  /// ten instants a step of the integrator, or eight a harmonic.
  std::vector<double> probe_peak_to_peak;
  Mat sections;  ///< x and y of the stations in turn (rows) after every whole revolution (columns) [m]
};

/// Of the motion from a state at phase 0.
/// @param revolutions  its period, any positive number
OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations, const Vec& y,
                           double revolutions);

/// Of a Fourier series of the reduced displacements.
OrbitMeasure measure_orbit(const Scene& scene, std::span<const Point> stations,
                           const Periodic& motion);

}  // namespace whirl::inline dyn
