#pragma once
// A disk in a ball or roller bearing.

#include <cmath>
#include <numbers>
#include <vector>

#include "libcontact/rolling_bearing.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// A rigid disk of mass m, loaded by its weight and an unbalance, in a bearing whose outer ring
/// stands.
struct RotorInBearing {
  double Omega = 500.0;
  double m = 2.0, c = 300.0, U = 2e-5, gravity = 30.0;
  RollingBearing bearing = balls();
  std::vector<RaceWaves> waves{};
  std::vector<RaceSpall> spalls{};

  static RollingBearing balls() {
    RollingBearing b;
    b.elements = 8;
    b.cage_ratio = 0.375;
    b.clearance = 10e-6;
    b.hertz_stiffness = 1e10;
    return b;
  }
  static RollingBearing rollers() {
    RollingBearing b = balls();
    b.kind = ElementKind::roller;
    b.hertz_stiffness = 0.0;
    b.line_stiffness = 3e7;
    return b;
  }

  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "disk", .m = m, .spins = true}};
    s.bearings = {test::bearing(body("disk"), isotropic(0.0, c))};
    if (U != 0.0) s.unbalances = {{.at = body("disk"), .moment = U}};
    s.gravity = gravity;
    Contact contact = contact_of(bearing, waves, spalls);
    contact.name = "bearing";
    contact.at = body("disk");
    all.contacts = {contact};
    return all;
  }
  Scene scene() const { return make_scene(model()); }

  /// How far the races stand out under an element at an angle of the rotor, and what they are to
  /// it after an angle more.
  double height(double element, double turned) const {
    double sum = 0.0;
    const auto angle_on = [&](Race race) { return element - (race == Race::inner ? turned : 0.0); };
    for (const RaceWaves& w : waves) {
      sum += w.height * std::cos(w.order * (angle_on(w.race) - w.angle));
    }
    for (const RaceSpall& s : spalls) {
      const double sharp = std::log(2.0) / (1.0 - std::cos(0.5 * s.width));
      sum -= s.depth * std::exp(sharp * (std::cos(angle_on(s.race) - s.angle) - 1.0));
    }
    return sum;
  }
  /// Radial force of an element that is pressed by a depth.
  double push(double depth) const {
    if (!(depth > 0.0)) return 0.0;
    return bearing.kind == ElementKind::ball
               ? bearing.hertz_stiffness * std::pow(depth, 1.5)
               : bearing.line_stiffness * depth * std::pow(depth / 1e-6, 1.0 / 9.0);
  }
  /// Acceleration, element by element.
  /// @param turned  angle that the rotor has turned by since time 0
  Vec2 acceleration(double turned, const Vec2& u, const Vec2& v) const {
    Vec2 f = U * Omega * Omega * Vec2(std::cos(turned), std::sin(turned)) - c * v -
             Vec2(0.0, m * gravity);
    for (int i = 0; i < bearing.elements; ++i) {
      const double a = bearing.cage_angle + whirl::cage_ratio(bearing) * turned +
                       2.0 * std::numbers::pi * i / bearing.elements;
      const Vec2 n(std::cos(a), std::sin(a));
      f -= push(n.dot(u) - 0.5 * (bearing.clearance - bearing.preload) + height(a, turned)) * n;
    }
    return f / m;
  }
};

/// Kinds of it, each with something that the others have not.
inline std::vector<RotorInBearing> rotors_in_bearings() {
  RotorInBearing balls, preloaded, rollers, worn;
  preloaded.bearing.clearance = 0.0;
  preloaded.bearing.preload = 1e-6;
  preloaded.bearing.cage_ratio = 0.4;
  preloaded.bearing.cage_angle = 0.3;
  rollers.bearing = RotorInBearing::rollers();
  worn.waves = {{.race = Race::inner, .order = 5.0, .height = 1e-6, .angle = 0.4},
                {.race = Race::outer, .order = 9.0, .height = 0.5e-6}};
  worn.spalls = {{.race = Race::outer, .angle = -1.5, .width = 0.2, .depth = 6e-6},
                 {.race = Race::inner, .angle = 0.7, .width = 0.3, .depth = 4e-6}};
  return {balls, preloaded, rollers, worn};
}

}  // namespace whirl::test
