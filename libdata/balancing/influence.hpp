#pragma once
/// Influence coefficients of a rotor from runs with trial weights.

#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// What was read in a run, and the weights that were on the rotor beside its own unbalance.
///
/// Weights are masses at the radius of their plane, w = m e^(i angle), readings vibrations of the
/// frequency of the speed, reading = Re(V e^(i theta)); both angles are in the direction of
/// rotation from the same mark, and theta is the angle that the rotor has turned by.
struct BalancingRun {
  std::string name;
  CVec weights;   ///< per plane [kg]
  CVec readings;  ///< per reading, a probe at a speed [m, m/s or m/s^2]; NaN: it was not read
};

/// The line of one reading: V = start + coefficients w.
struct InfluenceLine {
  Complex start;      ///< of the rotor without any of the weights
  CVec coefficients;  ///< per plane [reading/kg]
  /// (X^H X)^-1 of the runs that have this reading, X = (1, w): the covariance of start and
  /// coefficients over the variance of a reading.
  CMat shape;
  Eigen::Index spare = 0;  ///< runs beyond those that determine the line
  double left = 0.0;       ///< sum of the squares of what the runs differ from the line
  double moved = 0.0;      ///< the largest distance of two runs

  Complex at(const CVec& weights) const { return start + (coefficients.transpose() * weights)(0); }
};

/// Fits a line to every reading, by least squares over all runs that have it:
///
///   V_r = V_0 + sum over planes of a_k w_k,r
///
/// A run without weights and one more run for each plane determine it, whether trial weights are
/// taken off again or stay; further runs say how well they repeat.
///
/// @param runs    one or more, all with as many weights and readings
/// @param planes  names, for messages
/// @return        a line per reading
/// @throws OptionError  if the runs do not determine the coefficients of a plane, with its name
/// @source [Goodman1964]
std::vector<InfluenceLine> influence_lines(const std::vector<BalancingRun>& runs,
                                           const std::vector<std::string>& planes);

/// Lines with the coefficients of a model, through what runs read on the average.
/// @param coefficients  readings x planes [reading/kg]
/// @throws OptionError  for a reading that no run has
std::vector<InfluenceLine> lines_of_model(const std::vector<BalancingRun>& runs,
                                          const CMat& coefficients);

/// The largest distance of a run from its line over the largest distance of two runs: 0 of a rotor
/// whose vibration follows its weights linearly. Of lines without spare runs it is 0, too.
/// @param weight  of the readings, which may measure different things
double nonlinearity(const std::vector<InfluenceLine>& lines, const std::vector<BalancingRun>& runs,
                    const Vec& weight);

}  // namespace whirl::inline data
