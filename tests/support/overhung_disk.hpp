#pragma once
/// A disk at the end of a cantilever between a ring and a face.

#include "libdyn/system/model.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::test {

/// Set T of models/overhung_face_rub.toml, without a smoothing of friction: period 3.
inline Model overhung_disk() {
  Model m;
  m.speed = 230.0;
  m.has_speed = true;
  Segment shaft = massless_cylinder(0.11723, 0.01, 1);
  shaft.material.E *= 20.37971 / EI(shaft);
  const Station end = node(2);
  m.structure = cantilever(shaft);
  m.structure.disks = {{.name = "disk", .at = end, .m = 0.573, .Id = 3.85e-4, .Ip = 7.06e-4}};
  m.structure.unbalances = {{.at = end, .moment = 0.573 * 4.0669e-4}};
  m.structure.damping.stiffness = 2.421527e-4;
  m.structure.gravity = 9.81;
  m.contacts = {{.name = "ring",
                 .at = end,
                 .clearance = 7.1502e-4,
                 .friction = {.mu = 0.10086, .slip = Slip::forward},
                 .law = Radial<>{.k = 451975.33}},
                {.name = "face",
                 .at = end,
                 .clearance = 3.9672e-4,
                 .friction = {.mu = 0.074972, .slip = Slip::forward},
                 .law = Face<>{.k = 91260.308, .radius = 0.05}}};
  return m;
}

/// Its friction on the face is that of the actual slip, smoothed.
inline Model overhung_disk_with_smooth_face() {
  Model m = overhung_disk();
  m.contacts[1].friction.slip = Slip::actual;
  m.contacts[1].friction.tolerance = 1.0;
  return m;
}

}  // namespace whirl::test
