// A thousand motions at once: the rotor and stator with friction from 0 to 0.3. The lanes of SIMD
// registers are motions; every number is the one that the motion has alone.
//
//   03_batch models/jeffcott_stator.toml

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/model/model_family.hpp"
#include "libio/model/model_file.hpp"

int main(int argc, char** argv) {
  using namespace whirl;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} models/jeffcott_stator.toml\n", argv[0]);
    return 2;
  }
  const Model model = read_model(argv[1]);
  const ModelFamily family(model, {*parse_axis("contact.ring.friction=0:0.3:0.1", 0)});

  std::vector<std::shared_ptr<const Scene>> scenes;
  std::vector<Trajectory> motions;
  for (int i = 0; i < 1000; ++i) {
    scenes.push_back(family.scene(std::vector{0.3 * i / 999.0}));
    motions.push_back({.system = &scenes.back()->contacts,
                       .state = start_state(model, *scenes.back(), nullptr),
                       .revolutions = 50});
  }
  integrate_batch(motions, {.measures = true});

  double least = 1.0, most = 0.0;
  for (const Trajectory& t : motions) {
    if (t.outcome != Outcome::reached_end) return 1;
    const double duty = t.contacts.at(0).in_touch / (50 * t.system->period());
    least = std::min(least, duty);
    most = std::max(most, duty);
  }
  fmt::print("in touch for {:.1f} to {:.1f} % of the time\n", 100.0 * least, 100.0 * most);
  return most > least ? 0 : 1;
}
