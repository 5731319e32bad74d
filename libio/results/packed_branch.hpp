#pragma once
/// Points of branches as numbers, see packed.hpp.

#include "libdyn/branches/branch.hpp"
#include "libio/results/packed.hpp"

namespace whirl::inline io {

/// All of a point but the names of its contacts; mean slips are not known of orbits.
void pack_point(auto& in, auto& point) {
  in(point.value), in(point.z), in(point.tangent), in(point.step), in(point.residual);
  in(point.multipliers);
  in.size(point.contacts);
  for (auto& c : point.contacts) {
    in(c.duty), in(c.impacts), in(c.sticking);
    in(c.max_normal), in(c.max_tangential), in(c.touch_time);
  }
}

}  // namespace whirl::inline io
