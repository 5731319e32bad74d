#pragma once
/// Trajectories of rotors that each have a scene of their own.

#include <memory>
#include <vector>

#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// Scenes, and trajectories that start where the models do.
struct Trajectories {
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<Trajectory> all;

  template <class Builder>
  Trajectory& add(const Builder& rotor, long revolutions) {
    const Model model = rotor.model();
    scenes.push_back(std::make_unique<Scene>(make_scene(model)));
    all.push_back({.system = &scenes.back()->contacts,
                   .state = start_of(model, *scenes.back()),
                   .revolutions = revolutions});
    return all.back();
  }
};

}  // namespace whirl::test
