#pragma once

#include <cstddef>

namespace whirl::inline dyn {

/// The points of a study that one call computes of several that share it: every so-manieth, so that
/// each has its part of those that take long.
struct Stripe {
  std::size_t number = 1, of = 1;

  bool is_all() const { return of == 1; }
  bool has(std::size_t point) const { return point % of == number - 1; }
  /// How many of so many points it has.
  std::size_t points(std::size_t all) const { return (all + of - number) / of; }
};

}  // namespace whirl::inline dyn
