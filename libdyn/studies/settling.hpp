#pragma once
/// Whether a motion has settled: what its sections say.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline dyn {

/// How averages over sections change along them.
struct Drift {
  /// Largest change of a mean or mean square from the first half of the sections to the second, by
  /// what sections spread about their mean; 0 where they repeat.
  double change = 0.0;
  double rate = 0.0;    ///< at which that change decays per section; 0: it does not do so steadily
  double left = 0.0;    ///< of it at the last section, likewise by the spread; with a rate only
  double spread = 0.0;  ///< of the sections about their mean, in the units of the points
};

/// Drift of sections of one motion.
///
/// Averages are smooth (see smooth_weights), over halves of the sections that begin at their first,
/// at a quarter and at the middle: a_1, a_2, a_3. On a torus they agree to many digits, in chaos to
/// one over the root of their number. What decays to where it stays,  a(k) = a + b e^(-rate k), has
/// e^(-rate n / 4) = (a_3 - a_2) / (a_2 - a_1)  for n sections.
///
/// @param points  one section per column, at least 8, in units in which all directions count alike
/// @source [Das2017] for the averages, [SanderMeiss2020] for telling order from chaos by them
Drift drift_of(const Mat& points);

}  // namespace whirl::inline dyn
