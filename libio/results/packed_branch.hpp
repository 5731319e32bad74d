#pragma once
/// Points of branches as numbers, see packed.hpp.

#include "libdyn/branches/branch.hpp"
#include "libio/results/packed.hpp"

namespace whirl::inline io {

/// All members of a point but the names of its contacts; mean slips are not known of orbits.
void pack_point(auto& in, auto& point) {
  auto& [value, z, tangent, step, multipliers, residual, contacts] = point;
  in(value), in(z), in(tangent), in(step), in(residual);
  in(multipliers);
  in.size(contacts);
  for (auto& contact : contacts) {
    auto& [name, duty, impacts, sticking, max_normal, max_tangential, mean_slip, touch_time] =
        contact;
    in(duty), in(impacts), in(sticking);
    in(max_normal), in(max_tangential), in(touch_time);
  }
}

}  // namespace whirl::inline io
