#pragma once
/// Newton's method.

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

/// J^-1 r, a step of Newton's method; nothing where J is as good as singular.
inline std::optional<Vec> newton_step(const Mat& J, const Vec& r) {
  constexpr double singular = 1e-14;  // reciprocal condition, at which no digit of a step is right
  const DenseLu<Mat> lu(J);
  if (!(lu.rcond() > singular)) return std::nullopt;
  return Vec(lu.solve(r));
}

/// Whether a residual is small, or nearly so and no longer falling, as rounding and events may keep
/// it from falling.
inline bool has_converged(double residual, double before, double accurate = 1e-11) {
  constexpr double reachable = 1e-8;
  return residual < accurate || (residual < reachable && residual > 0.5 * before);
}

struct NewtonOptions {
  int most_steps = 12;
  double accurate = 1e-11;  ///< residual that is small
  /// The search ends at a residual above largest_growth times the residual before, or above
  /// largest.
  double largest_growth = std::numeric_limits<double>::infinity();
  double largest = std::numeric_limits<double>::infinity();
  int most_halvings = 0;  ///< of a step that makes the residual too large
  double worse = 2.0;     ///< residual over the residual before that is too large
};

enum class NewtonEnd {
  converged,
  undefined,  ///< the equations are not defined where the last step leads
  most_steps,
  diverged,
  singular  ///< there is no step
};

/// How a search for a solution went.
struct NewtonSearch {
  NewtonEnd end = NewtonEnd::converged;
  std::vector<double> residuals{};  ///< before every step, and after the last

  bool has_converged() const { return end == NewtonEnd::converged; }
  int steps() const { return static_cast<int>(residuals.size()) - 1; }
  /// Why no solution was found; for any end but `converged` and `undefined`.
  Failure failure(std::string_view nothing, std::string_view singular) const {
    if (end == NewtonEnd::singular) return fmt::format("{}: {}", nothing, singular);
    const double last = residuals.empty() ? 0.0 : residuals.back();
    return fmt::format("{}: after {} steps of Newton's method the residual is {:.1e}", nothing,
                       steps(), last);
  }
};

/// Solves equations r(x) = 0 by steps dx with J(x) dx = r(x), x -> x - dx.
///
/// A step that makes the residual too large is halved until the residual is not too large; if no
/// halving helps, the best of these steps is taken. Far from a solution, halving keeps the search
/// from running away; near a solution, whole steps converge quadratically.
///
/// @param at     where the search begins and ends: any x with `double residual`, the norm of r
///               there, infinite or NaN where r is not defined
/// @param step   x -> J^-1 r there, as an std::optional<Vec>
/// @param moved  (x, dx) -> x - dx with its residual
/// @source [StoerBulirsch2002], 5.3 and 5.4
template <class At, class Step, class Moved>
NewtonSearch newton(At& at, Step&& step, Moved&& moved, const NewtonOptions& options = {}) {
  constexpr double undefined = std::numeric_limits<double>::infinity();
  NewtonSearch search;
  const auto ended = [&](NewtonEnd how) {
    search.end = how;
    return search;
  };
  for (double before = undefined;; before = search.residuals.back()) {
    search.residuals.push_back(at.residual);
    if (!(at.residual < undefined)) return ended(NewtonEnd::undefined);
    if (has_converged(at.residual, before, options.accurate)) return search;
    if (search.steps() == options.most_steps) return ended(NewtonEnd::most_steps);
    if (at.residual > options.largest_growth * before || at.residual > options.largest) {
      return ended(NewtonEnd::diverged);
    }
    const std::optional<Vec> whole = step(std::as_const(at));
    if (!whole) return ended(NewtonEnd::singular);
    At best = moved(std::as_const(at), *whole);
    double share = 1.0;
    for (int k = 0; k < options.most_halvings; ++k) {
      if (best.residual < options.worse * at.residual) break;
      share *= 0.5;
      At part = moved(std::as_const(at), share * *whole);
      if (!(part.residual >= best.residual)) best = std::move(part);
    }
    at = std::move(best);
  }
}

}  // namespace whirl::inline base
