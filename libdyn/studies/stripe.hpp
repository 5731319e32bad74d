#pragma once

#include <cstddef>

namespace whirl::inline dyn {

/// The points of a study that one of several calls computes: point `number` of every `of` points,
/// so that each call has its part of the points that take long.
struct Stripe {
  std::size_t number = 1, of = 1;

  bool is_all() const { return of == 1; }
  bool has(std::size_t point) const { return point % of == number - 1; }
  /// How many of so many points are in the stripe.
  std::size_t points(std::size_t all) const { return (all + of - number) / of; }
};

}  // namespace whirl::inline dyn
