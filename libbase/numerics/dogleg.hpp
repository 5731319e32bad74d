#pragma once
/// Nonlinear least squares with bounds and a sparse Jacobian: Powell's dogleg.

#include <functional>
#include <limits>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Least squares: minimize |r(x)|^2 / 2 within bounds.
struct LeastSquares {
  /// Sets the residuals r at x and, where J is not null, their derivatives J, r.size() x x.size().
  /// @return  false where r is not defined
  std::function<bool(const Vec& x, Vec& r, Sparse* J)> evaluate;
  Vec lower{};  ///< bounds of x; empty: none. Infinite where a side has none
  Vec upper{};
};

struct DoglegOptions {
  int most_iterations = 100;
  double cost_tolerance = 1e-6;  ///< relative change of the cost below which a step is the last
  double step_tolerance = 1e-9;  ///< length of a step over that of x, below which the search ends
  /// Steps in a row that may increase the cost: narrow bent valleys are crossed instead of
  /// followed.
  int most_uphill_steps = 5;
  std::function<bool()> is_stopped{};
};

enum class DoglegEnd {
  converged,
  most_iterations,
  stopped,
  undefined  ///< r is not defined at the start, or wherever a step leads
};

struct DoglegResult {
  Vec x;                                                  ///< where the cost was least
  double cost = std::numeric_limits<double>::infinity();  ///< |r|^2 / 2 there
  int iterations = 0;                                     ///< steps that were tried, and the start
  DoglegEnd end = DoglegEnd::undefined;
};

/// Searches from x on. Each step is the Gauss-Newton step if that step is within the trust region;
/// else a step that goes from the minimum along the steepest descent towards the Gauss-Newton step,
/// as far as the region reaches.
///
///   (J^T J + nu D^2) s = -J^T r,   |D s| <= radius,   D = column norms of J
///
/// A variable at a bound is left out of a step where the cost falls beyond that bound; a step that
/// would cross a bound ends there. Steps may increase the cost for a while: a step is taken if the
/// cost falls as predicted either from the last place or from an earlier one.
///
/// @param x  start, within bounds
/// @throws Interrupted  where somebody asks to interrupt (libbase/system/interruption.hpp)
/// @source [Powell1970] the step; [ConnGouldToint2000] sec. 10.1 non-monotone acceptance
DoglegResult dogleg(const LeastSquares& problem, Vec x, const DoglegOptions& options = {});

}  // namespace whirl::inline base
