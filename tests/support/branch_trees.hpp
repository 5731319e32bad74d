#pragma once
/// A rotor in its stator whose orbits double their period, for studies along its friction.

#include "libdyn/motions/start.hpp"
#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// At 138.4 rad/s along friction, and in the plane of friction and contact stiffness.
struct DoublingRotor {
  double stiffness = 64e6;  ///< of the contact [N/m]

  std::shared_ptr<const Scene> scene(double friction, double k) const {
    return std::make_shared<const Scene>(
        RotorStator{.Omega = 138.4, .kC = k, .mu = friction}.scene());
  }
  ParameterScenes scenes() const {
    return {scene(0.13, stiffness), [*this](double mu) { return scene(mu, stiffness); }};
  }
  PlaneScenes plane() const {
    return {scene(0.13, stiffness), [*this](double mu, double k) { return scene(mu, k); }};
  }
  BranchTreeOptions options() const {
    return {.along = {.low = 0.12,
                      .high = 0.14,
                      .first = 0.13,
                      .largest_step = 0.002,
                      .goes_both = true},
            .generations = 1,
            .stations = {scenes().first->assembler.point(body("rotor"))}};
  }
  BifurcationCurveOptions curve_options() const {
    return {.along = options().along,
            .across = {.low = 62e6,
                       .high = 66e6,
                       .first = stiffness,
                       .largest_step = 0.5e6,
                       .goes_both = true}};
  }

  /// The first branches, from the model's start.
  BranchTree begun() const {
    const ParameterScenes all = scenes();
    Trajectory motion{.system = &all.first->contacts,
                      .state = start_state(RotorStator{}.model(), *all.first, nullptr),
                      .revolutions = 500};
    integrate_single(motion, {});
    return begin_tree(all, motion.state.y, options());
  }
};

}  // namespace whirl::test
