// A rotor made in code: a disk amid a massless shaft, whose frequency is sqrt(48 E I / (m L^3)).

#include <cmath>
#include <cstdio>
#include <numbers>

#include "libdyn/motions/simulate.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/modes.hpp"

int main() {
  const double length = 0.8, diameter = 0.02, mass = 5.0;
  whirl::Segment half{.material = {.name = "steel", .rho = 0.0, .E = 211e9, .G = 81.2e9, .nu = 0.3},
                      .length = length,
                      .left = {.outer = diameter},
                      .right = {.outer = diameter},
                      .elements = 2,
                      .theory = whirl::Theory::euler_bernoulli};
  const whirl::Station left{.kind = whirl::Station::Kind::position, .z = 0.0},
      right{.kind = whirl::Station::Kind::position, .z = length},
      middle{.kind = whirl::Station::Kind::position, .z = 0.5 * length};
  whirl::Model model;
  model.structure.shaft = {half};
  model.structure.bearings = {{.from = left, .is_rigid = true}, {.from = right, .is_rigid = true}};
  model.structure.disks = {{.at = middle, .m = mass}};
  model.structure.unbalances = {{.at = middle, .moment = 1e-4}};
  model.speed = 100.0;
  const whirl::Scene scene = whirl::make_scene(model);
  const double found = whirl::complex_modes(scene.system, 1).oscillatory.at(0).frequency();
  const double I = std::numbers::pi * std::pow(diameter, 4) / 64.0;
  const double exact = std::sqrt(48.0 * 211e9 * I / (mass * std::pow(length, 3)));
  std::printf("%.6f rad/s, in closed form %.6f rad/s\n", found, exact);
  const whirl::Simulation motion = whirl::simulate(
      scene, {.y = whirl::Vec::Zero(scene.contacts.size())}, {.revolutions = 10, .discard = 0});
  const bool is_right = std::abs(found - exact) < 1e-6 * exact &&
                        motion.integration.outcome == whirl::Outcome::reached_end;
  return is_right ? 0 : 1;
}
