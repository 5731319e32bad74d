#pragma once
/// Whether a motion has settled, by its sections.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline dyn {

/// How averages over sections change along them.
struct Drift {
  /// Largest change of a mean or mean square from the first half of the sections to the second, by
  /// what sections spread about their mean; 0 where they repeat.
  double change = 0.0;
  double rate = 0.0;    ///< at which that change decays per section; 0: no steady decay
  double left = 0.0;    ///< of the change at the last section, by the spread; with a rate only
  double spread = 0.0;  ///< of the sections about their mean, in the units of the points
};

/// Drift of sections of one motion.
///
/// Averages a_1, a_2, a_3 are smooth (see smooth_weights), over halves of the sections that begin
/// at the first one, at a quarter and at the middle. On a torus the averages agree to many digits,
/// in chaos to one over the root of the number of sections. An average that decays to its limit,
/// a(k) = a + b e^(-rate k), has e^(-rate n / 4) = (a_3 - a_2) / (a_2 - a_1) for n sections.
///
/// @param points  one section per column, at least 8, in units in which all directions count alike
/// @source [Das2017] for the averages, [SanderMeiss2020] for telling order from chaos by averages
Drift drift_of(const Mat& points);

}  // namespace whirl::inline dyn
