#pragma once
/// How small deviations of a motion jump where its acceleration does.

#include <optional>

#include "libdyn/system/events.hpp"

namespace whirl::inline dyn {

/// Deviations after an event are dy + jump (gradient . dy).
///
///   S = I + (f+ - f-) grad(g)^T / (grad(g) . f-),   g = 0 at the event
///
/// Into sticking, S projects onto motions without slip.
///
/// @source [LeineNijmeijer2004], sec. 7.1
struct Saltation {
  Vec jump;      ///< (f+ - f-) / (rate of g), size 2 n
  Vec gradient;  ///< of g by the state, size 2 n

  /// log |det S|, which adds to the integral of the divergence.
  double log_determinant() const;
};

/// Saltation of an event; nothing where the acceleration does not jump. It jumps where a damped
/// linear contact touches, and where friction that switches exactly turns round or begins to stick.
///
/// @param y       state at the event
/// @param before  states of the contacts until the event
/// @param after   states of the contacts from the event on
std::optional<Saltation> saltation(const ContactSystem& system, const Event& event,
                                   const Instant& at, const Vec& y, const ContactStates& before,
                                   const ContactStates& after);

}  // namespace whirl::inline dyn
