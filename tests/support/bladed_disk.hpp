#pragma once
/// A bladed disk on a spring; critical speed 500 rad/s.

#include "libdyn/system/model.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::test {

inline BladeTip<> five_blades() {
  return {.blades = 5,
          .tip_radius = 0.1,
          .blade_length = 0.04,
          .bending_stiffness = 20.0,
          .line_density = 0.5,
          .k = 1e10};
}

/// Its tips rub with smoothed friction.
inline Model bladed_disk(double speed = 450.0) {
  Model m;
  m.speed = speed;
  m.has_speed = true;
  const Station disk = body("disk");
  m.structure.bodies = {{.name = "disk", .m = 2.0, .spins = true}};
  m.structure.bearings = {bearing(disk, isotropic(5e5, 300.0))};
  m.structure.unbalances = {{.at = disk, .moment = 3e-5}};
  m.structure.gravity = 25.0;
  m.contacts = {{.name = "tips",
                 .at = disk,
                 .clearance = 1e-4,
                 .friction = {.mu = 0.1, .tolerance = 1.0},
                 .law = five_blades()}};
  return m;
}

}  // namespace whirl::test
