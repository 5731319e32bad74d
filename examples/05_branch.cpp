// A branch of periodic orbits along the friction of the contact, with its bifurcations.
//
//   05_branch models/jeffcott_stator.toml

#include <fmt/format.h>

#include <cstdio>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libio/model/model_family.hpp"
#include "libio/model/model_file.hpp"

int main(int argc, char** argv) {
  using namespace whirl;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} models/jeffcott_stator.toml\n", argv[0]);
    return 2;
  }
  const Model model =
      read_model(argv[1], {"operation.speed=138.4 rad/s", "contact.ring.stiffness=64 MN/m"});
  const ModelFamily family(model, {*parse_axis("contact.ring.friction=0.1:0.15:0.002", 0)});
  const auto scene_at = [&](double friction) { return family.scene(std::vector{friction}); };

  const auto first = scene_at(0.1);
  const Simulation transient =
      simulate(*first, start_state(model, *first, nullptr), {.revolutions = 1, .discard = 400});
  Continuation walk = orbit_continuation(
      [&](double friction) { return flow_of(scene_at(friction), *first); }, transient.end.y,
      {.low = 0.1, .high = 0.15, .first = 0.1, .largest_step = 0.002});
  while (walk.advance()) {
  }
  const Branch& branch = walk.branch();
  fmt::print("{} orbits; {}\n", branch.points.size(), branch.end_text());
  for (const Bifurcation& b : branch.bifurcations) {
    fmt::print("{} at friction {:.6f}\n", name_of(b.kind), b.at.value);
  }
  return branch.bifurcations.empty() ? 1 : 0;
}
