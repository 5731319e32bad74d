#pragma once
/// Rotors on oil films.

#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::test {

/// The two-disk rotor of "Double-rotor system under the coupling of rubbing and oil-film force",
/// the usual set of its data: bodies 1 and 4 are journals, 2 and 3 disks, coordinates x, y of each.
struct TwoDisksOnFilms {
  double Omega = 460.0;                       ///< [rad/s]
  double viscosity = 0.018;                   ///< [Pa.s]
  double ring = 0.15e-3, Kc = 3e7, mu = 0.1;  ///< rub: clearance [m], stiffness [N/m], friction
  double M2 = 32.1;                           ///< of each disk [kg]
  StartFrom from = StartFrom::equilibrium;

  Model model() const {
    Model m;
    m.speed = Omega;
    m.has_speed = true;
    Structure& s = m.structure;
    const char* names[] = {"1", "2", "3", "4"};
    for (const char* name : names) {
      const bool is_disk = *name == '2' || *name == '3';
      s.bodies.push_back({.name = name, .m = is_disk ? M2 : 4.0, .spins = true});
      s.bearings.push_back(bearing(body(name), isotropic(0.0, is_disk ? 2100.0 : 1050.0)));
      if (is_disk) {
        s.unbalances.push_back({.at = body(name), .moment = M2 * 0.05e-3});
        m.contacts.push_back({.name = name,
                              .at = body(name),
                              .clearance = ring,
                              .friction = {.mu = mu, .slip = Slip::forward},
                              .law = Radial<>{.k = Kc}});
      } else {
        m.films.push_back(
            {.name = name,
             .at = body(name),
             .bearing = {
                 .radius = 0.025, .length = 0.012, .clearance = 0.11e-3, .viscosity = viscosity}});
      }
    }
    for (int i = 0; i < 3; ++i) {
      Connection link = bearing(body(names[i]), isotropic(25e6, 0.0));
      link.to = body(names[i + 1]);
      s.links.push_back(link);
    }
    s.gravity = 9.81;
    m.start.from = from;
    return m;
  }
  Scene scene() const { return make_scene(model()); }
};

/// A mass that an oil film alone holds, coordinates x, y; the film is "film".
struct MassOnFilm {
  double Omega = 300.0;   ///< [rad/s]
  double m = 10.0;        ///< [kg]
  double gravity = 9.81;  ///< [m/s^2]
  double U = 0.0;         ///< unbalance [kg.m]
  JournalBearing bearing{.radius = 0.025, .length = 0.012, .clearance = 1e-4, .viscosity = 0.02};
  Vec2 offset = Vec2::Zero();  ///< [m]

  Model model() const {
    Model s;
    s.speed = Omega;
    s.has_speed = true;
    s.structure.bodies = {{.name = "journal", .m = m, .spins = true}};
    if (U != 0.0) s.structure.unbalances = {{.at = body("journal"), .moment = U}};
    s.structure.gravity = gravity;
    s.films = {{.name = "film", .at = body("journal"), .bearing = bearing, .offset = offset}};
    return s;
  }
  Scene scene() const { return make_scene(model()); }
};

}  // namespace whirl::test
