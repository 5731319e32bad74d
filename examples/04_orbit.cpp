// A periodic orbit by multiple shooting, and its Floquet multipliers: P1 of the rotor and stator.
//
//   04_orbit models/jeffcott_stator.toml

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libio/model/model_file.hpp"

int main(int argc, char** argv) {
  using namespace whirl;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} models/jeffcott_stator.toml\n", argv[0]);
    return 2;
  }
  const Model model =
      read_model(argv[1], {"operation.speed=136 rad/s", "contact.ring.stiffness=150 MN/m",
                           "contact.ring.friction=0.1"});
  const Scene scene = make_scene(model);
  const Simulation transient =
      simulate(scene, start_state(model, scene, nullptr), {.revolutions = 1, .discard = 50});
  const PeriodicOrbit orbit = find_orbit(flow_of(scene.contacts), transient.end.y, {.period = 1});
  if (!orbit.is_good()) {
    fmt::print("{}\n", orbit.failure);
    return 1;
  }
  for (const Complex exponent : orbit.exponents()) {
    fmt::print("{:+.6f} {:+.6f} i  1/s\n", exponent.real(), exponent.imag());
  }
  // docs/validation.md, to all its digits
  return std::abs(orbit.exponents()(0).real() + 2.944044) < 1e-6 ? 0 : 1;
}
