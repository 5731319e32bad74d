#pragma once
/// How far a reduced system is from the whole one.

#include <algorithm>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduce.hpp"

namespace whirl::inline fe {

/// Errors of a reduced system beside the whole one.
struct ReductionError {
  /// An eigenvalue of the full system in the band and the nearest one of the reduced one [rad/s].
  struct Pair {
    Complex full, reduced;
    double error() const { return std::abs(reduced - full) / std::abs(full); }
  };
  std::vector<Pair> pairs;  ///< ascending frequency
  double band = 0.0;        ///< [rad/s]
  double receptance = 0.0;  ///< largest error of the receptance between ports in the band, relative
                            ///< to itself plus its static value
  bool within_tolerance = true;

  /// Largest relative error of an eigenvalue.
  double eigenvalue() const {
    double largest = 0.0;
    for (const Pair& pair : pairs) largest = std::max(largest, pair.error());
    return largest;
  }
};

/// What reductions of a system are compared with: its eigenvalues in the band and the receptances
/// between its ports. Found once for all reductions.
class WholeSystem {
 public:
  /// @param ports  rows of the points whose receptance counts, of the system's size
  /// @param band   highest frequency of interest [rad/s]
  /// @throws NumericalError  as complex_modes
  WholeSystem(const System& system, const std::vector<Vec>& ports, double band);

  /// Errors of a reduction of this system.
  ReductionError error_of(const ReducedSystem& reduced) const;

 private:
  /// Receptance between the ports at a frequency.
  struct Receptance {
    double w;  ///< [rad/s]
    CMat matrix;
  };

  double band_;
  bool has_rigid_modes_ = false;
  std::vector<Complex> eigenvalues_;  ///< in the band, ascending frequency
  CMat ports_;
  std::vector<Receptance> receptances_;  ///< ascending frequency
};

}  // namespace whirl::inline fe
