// A rotor that bounces in a ring: a model file, its motion, and what its contacts did.
//
//   02_contact models/two_disk_mac.toml

#include <fmt/format.h>

#include <cstdio>

#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/model/model_file.hpp"

int main(int argc, char** argv) {
  using namespace whirl;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} models/two_disk_mac.toml\n", argv[0]);
    return 2;
  }
  const Model model = read_model(argv[1]);
  const Scene scene = make_scene(model);  // assembled, reduced to a few modes, with its contacts
  const MotionState start = start_state(model, scene, nullptr);
  const Simulation motion = simulate(scene, start, {.revolutions = 50, .discard = 300});

  const Recording& seen = motion.recording;
  for (std::size_t i = 0; i < seen.contacts.size(); ++i) {
    fmt::print(
        "{}: in touch for {:.1f} % of the time, {} impacts in {} revolutions, up to {:.0f} N\n",
        model.contacts[i].name, 100.0 * seen.contacts[i].duty, seen.contacts[i].impacts,
        seen.revolutions, seen.contacts[i].max_normal);
  }
  return seen.contacts.at(0).impacts > 0 ? 0 : 1;
}
