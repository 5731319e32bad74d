#pragma once
/// Orbits that motions approach, found from sections that repeat, and proven to attract.

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "libdyn/studies/classify.hpp"

namespace whirl::inline dyn {

/// Largest multiplier of an orbit that attracts; the error of a multiplier is below the distance of
/// this number from one.
constexpr double largest_attracting = 1.0 - 1e-7;

/// An orbit that is looked for.
struct OrbitCandidate {
  ClassifyCandidate* of;  ///< the motion that may approach it
  int period;             ///< [revolutions]
  double farthest;        ///< distance of the orbit from the motion's end, at most [length scales]
  Vec y;                  ///< state of the orbit at phase 0, at first that of the motion
  double residual = std::numeric_limits<double>::infinity();  ///< after its period [length scales]
  std::optional<Vec> exponents{};  ///< set once found; descending [1/revolution]
  bool is_free = false;            ///< no contact happens on the way to the orbit or on it
};

/// Smallest period with which the last sections repeat within a bound; 0: none.
/// @param sections  states at phase 0, one after the other
/// @param bound     of the distance between sections a period apart [length scales]
/// @param longest   period that is looked for [revolutions]
int repeating_period(const ContactSystem& system, const std::vector<double>& sections, double bound,
                     int longest);

/// Newton's method on the return maps; candidates that are no attracting orbits are removed.
/// @param tolerance   of a step, where it is finer than the one that orbits are found with
/// @param watch       as in BatchOptions, with the revolutions of each pass; false: stop
/// @param is_patient  goes on where convergence is slow
void find_orbits(std::vector<OrbitCandidate>& candidates, double tolerance,
                 const std::function<bool(long)>& watch, bool is_patient);

/// Whether a motion stands still all through a revolution; false under unbalance and other loads
/// that are not constant.
/// @param tolerance  of a step
bool stands_still(const ClassifyCandidate& motion, double tolerance);

}  // namespace whirl::inline dyn
