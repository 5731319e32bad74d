#pragma once
/// Correction weights that make what is left of a vibration small.

#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/field.hpp"

namespace whirl::inline data {

/// What a correction makes small.
enum class BalancingCriterion {
  least_squares,  ///< the sum of the weighted squares of what is left
  min_max         ///< the largest of what is left, weighted
};
constexpr auto choices(BalancingCriterion) {
  return std::array{Choice<BalancingCriterion>{"least-squares", BalancingCriterion::least_squares},
                    Choice<BalancingCriterion>{"min-max", BalancingCriterion::min_max}};
}

/// A vibration and what weights do to it: V + A w is left.
struct CorrectionProblem {
  CMat A;      ///< influence coefficients, readings x planes; readings >= planes [reading/kg]
  CVec V;      ///< the vibration that is to be balanced, per reading
  Vec weight;  ///< of the readings, nonnegative, those of some planes' number above zero
  Vec limit;   ///< largest mass per plane, infinite: none [kg]
  BalancingCriterion criterion = BalancingCriterion::least_squares;
};

struct Correction {
  CVec weights;            ///< per plane [kg]
  CVec left;               ///< V + A w, per reading
  double objective = 0.0;  ///< root of the sum of squares, or largest, of weight times what is left
  double bound = 0.0;      ///< proven: no weights within the limits make the objective smaller
};

/// Finds the weights.
///
/// Without limits least squares are solved by a singular value decomposition. All else is the
/// convex problem
///
///   minimize tau   with   d_j^2 |V_j + (A w)_j|^2 <= tau   and   |w_k|^2 <= limit_k^2
///
/// (or the sum of squares in place of tau), solved by Newton steps along the central path of
/// logarithmic barriers. The multipliers lambda, mu >= 0 found there, whatever they are, give the
/// lower bound
///
///   min over w of sum lambda_j d_j^2 |V_j + (A w)_j|^2 + sum mu_k (|w_k|^2 - limit_k^2),
///
/// with lambda summing up to one, which proves how near the weights are to the best ones.
///
/// @throws OptionError     for fewer readings than planes, and for planes that do the same to all
///                         readings, with the names of two of these
/// @throws NumericalError  if the objective is not proven to a millionth of the vibration
/// @param planes  names, for messages
/// @source [Goodman1964], least squares; [BoydVandenberghe2004], ch. 5 and 11, barriers and bounds
Correction correct(const CorrectionProblem& problem, const std::vector<std::string>& planes);

}  // namespace whirl::inline data
