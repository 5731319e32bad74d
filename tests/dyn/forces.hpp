#pragma once
// A rotor for tests of forces.

#include "libdyn/motions/start.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::motion_forces_test {

using namespace test;

/// A rotor that tilts and spins in a pedestal, coupled across: no two coordinates are alike.
struct Coupled {
  double Omega = 60.0;
  std::vector<Force> forces{};
  double clearance = 0.0;  ///< of a ring between them; 0: none

  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "rotor", .m = 3.0, .spins = true, .tilts = true, .Id = 0.05, .Ip = 0.08},
                {.name = "pedestal", .m = {4.0, 6.0}}};
    BearingCoefficients film = orthotropic(2e4, 3e4, 90.0, 120.0);
    film.K(0, 1) = 2e3;
    film.K(1, 0) = -3e3;
    film.Kt << 400.0, 30.0, 20.0, 500.0;
    film.Ct.diagonal().setConstant(2.0);
    s.bearings = {bearing(body("rotor"), film),
                  bearing(body("pedestal"), orthotropic(9e4, 5e4, 300.0, 200.0))};
    s.bearings[0].to = body("pedestal");
    s.unbalances = {{.at = body("rotor"), .moment = 1e-4, .phase = 0.5}};
    s.gravity = 9.81;
    s.forces = forces;
    if (clearance > 0.0) {
      all.contacts = {{.name = "ring",
                       .at = body("rotor"),
                       .against = body("pedestal"),
                       .clearance = clearance,
                       .friction = {.mu = 0.2, .radius = 0.05},
                       .law = Radial<>{.k = 1e6}}};
    }
    return all;
  }
  Scene scene() const { return make_scene(model()); }
};

inline Vec displacement(const Scene& scene, const MotionState& state) {
  return full_state(scene, state).displacement;
}

}  // namespace whirl::motion_forces_test
