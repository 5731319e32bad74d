// Modes of a rotor made in code: the two-disk rotor of [Friswell2010], example 5.9.1, on bearings.

#include <fmt/format.h>

#include <numbers>

#include "libfe/analyses/modes.hpp"
#include "libfe/parts/structure.hpp"

int main() {
  using namespace whirl;
  const auto at = [](double z) { return Station{.kind = Station::Kind::position, .z = z}; };

  Structure rotor;
  rotor.shaft = {{.material = {.name = "steel", .rho = 7810.0, .E = 211e9, .G = 81.2e9, .nu = 0.3},
                  .length = 1.5,
                  .left = {.outer = 0.05},
                  .right = {.outer = 0.05},
                  .elements = 6}};
  rotor.disks = {{.at = at(0.5), .m = 32.59, .Id = 0.1781, .Ip = 0.3296},
                 {.at = at(1.0), .m = 51.53, .Id = 0.4236, .Ip = 0.8051}};
  BearingCoefficients seat;
  seat.K.diagonal().setConstant(1e6);    // [N/m]
  seat.C.diagonal().setConstant(100.0);  // [N.s/m]
  for (const double z : {0.0, 1.5}) {
    rotor.bearings.push_back({.from = at(z), .coefficients = constant_bearing(seat)});
  }

  const double Omega = 4000.0 * std::numbers::pi / 30.0;  // [rad/s]
  const Modes modes = complex_modes(assemble(rotor, Omega), 6);
  for (const Mode& mode : modes.oscillatory) {
    fmt::print("{:8.2f} Hz  {:8}  zeta {:.4f}\n", mode.frequency() / (2.0 * std::numbers::pi),
               name_of(mode.whirl), mode.damping_ratio());
  }
  // gyroscopic moments part the two lowest modes, which are one pair at rest
  return modes.oscillatory.at(0).whirl == Whirl::backward &&
                 modes.oscillatory.at(1).whirl == Whirl::forward
             ? 0
             : 1;
}
