#pragma once
/// Periodic orbits as Fourier series: harmonic balance.

#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/orbits/harmonic_equations.hpp"

namespace whirl::inline dyn {

struct HarmonicOptions {
  int period = 1;     ///< of the orbit [revolutions]
  int harmonics = 0;  ///< of the orbit's frequency, at least the period; 0: as the tolerance asks
  int most_harmonics = 160;  ///< a revolution, where harmonics is 0
  double tolerance = 1e-5;   ///< of the truncation, where harmonics is 0 [length scales]
  int most_steps = 30;       ///< of Newton's method
  double accurate = 1e-11;   ///< residual of an orbit [length scales]

  /// @throws OptionError  if a number is outside of what it may be
  void check() const;
};

/// A periodic orbit, or how far the search for it got.
struct HarmonicOrbit {
  Periodic motion;                ///< of eta
  Periodic ports;                 ///< of the displacements at the forces
  double residual = 0.0;          ///< [length scales]
  std::vector<double> residuals;  ///< before every step of Newton's method, and after the last
  /// A number of harmonics that was tried on the way, and how far the motion moved from that of the
  /// level before [length scales].
  struct Level {
    int harmonics = 0, steps = 0;
    double change = 0.0;

    static constexpr auto columns() {
      return ColumnList{
          column("harmonics", &Level::harmonics, "", "that were tried"),
          column("steps", &Level::steps, "", "of Newton's method"),
          column("change", &Level::change, "", "from the one before [length scales]")};
    }
  };
  std::vector<Level> levels;
  /// Estimated error of displacements by the harmonics left out [length scales]; NaN if not known.
  double truncation = 0.0;
  Failure failure;

  bool is_good() const { return !failure; }
  int harmonics() const { return motion.harmonics(); }
  /// (eta, eta') at the start of revolution i.
  Vec state(int i = 0) const;
};

/// Finds a periodic orbit by harmonic balance with Newton's method.
///
/// The number of harmonics is doubled until the estimate of the truncation is below the tolerance:
/// changes that fall by q a doubling sum up to q / (1 - q) of the last one. Before a given number
/// of harmonics, half that number is tried.
///
/// @param start  Fourier coefficients of a motion near the orbit, n x any odd number
HarmonicOrbit find_harmonic_orbit(const HarmonicProblem& problem, const Mat& start,
                                  const HarmonicOptions& options);

/// Shortest period of an orbit by its harmonics, a divisor of its own period [revolutions].
int shortest_period(const HarmonicOrbit& orbit);

/// Largest difference of two motions at forces, whatever numbers of harmonics these have [m].
double distance(const Periodic& a, const Periodic& b);

}  // namespace whirl::inline dyn
